#include "palpation/world/tumour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "palpation/base/error.h"
#include "palpation/boundary/level_set.h"
#include "palpation/geometry/make_phantom.h"
#include "world/tissue.h"

namespace palpation {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Field distance_of(const Surface& surface, const Tumour& tumour) {
  return signed_distance(surface, std::vector<Tumour>{tumour});
}

/// At the vertex of a sheet with vertices every millimetre.
double at_mm(const Surface& surface, const Field& field, double x_mm, double y_mm) {
  return field[surface.nearest_vertex(Vec3(1e-3 * x_mm, 1e-3 * y_mm, 0.0))];
}

double area_inside(const Surface& surface, const Field& distance) {
  double area = 0.0;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    if (distance[vertex] >= 0.0) area += surface.vertex_areas()[vertex];
  }
  return area;
}

std::string message_of(const Surface& surface, const std::vector<Tumour>& tumours) {
  try {
    signed_distance(surface, tumours);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "nothing was thrown";
}

const Disk kPaperDisk{.centre_m = {0.011492, 0.030, 0.0}, .radius_m = 0.00625};
const Horseshoe kPaperHorseshoe{
    .centre_m = {0.009492, 0.020, 0.0}, .arc_radius_m = 0.007, .half_width_m = 0.0025};

// Centre (10, 20) mm, radius 5 mm: 5 at the centre, 0 at (13, 24) (a 3-4-5 triangle), -5 at (20,
// 20).
TEST(SignedDistance, OfADiskIsTheRadiusLessTheDistanceToItsCentre) {
  const Surface phantom = sheet(0.025, 0.050, 0.001);
  const Field distance =
      distance_of(phantom, Disk{.centre_m = {0.010, 0.020, 0.0}, .radius_m = 0.005});
  EXPECT_NEAR(at_mm(phantom, distance, 10, 20), 0.005, 1e-15);  // rounding of millimetres
  EXPECT_NEAR(at_mm(phantom, distance, 13, 24), 0.0, 1e-15);
  EXPECT_NEAR(at_mm(phantom, distance, 20, 20), -0.005, 1e-15);
}

// pi 6.25^2 = 122.7 mm2. Some 160 cells of 1/16 mm2 lie on the outline, each wrong by half a cell
// at most and with random sign: 1 mm2 is generous.
TEST(SignedDistance, OfThePapersDiskIsPositiveOnOneAndAQuarterSquareCentimetres) {
  const Surface phantom = sheet(0.025, 0.050, 0.00025);
  EXPECT_NEAR(area_inside(phantom, distance_of(phantom, kPaperDisk)), 1.227e-4, 0.01e-4);
}

// Arc 7 pi mm long, 5 mm wide, and two half caps of radius 2.5 mm: 109.96 + 19.63 = 129.6 mm2.
TEST(SignedDistance, OfThePapersHorseshoeIsPositiveOnItsClosedFormArea) {
  const Surface phantom = sheet(0.025, 0.050, 0.00025);
  EXPECT_NEAR(area_inside(phantom, distance_of(phantom, kPaperHorseshoe)), 1.296e-4,
              0.01e-4);  // as above
}

// Centre (10, 20) mm, arc of radius 6 mm facing +x, half width 2 mm: its middle is at (16, 20), its
// ends at (10, 14) and (10, 26).
TEST(SignedDistance, OfAHorseshoeIsItsHalfWidthLessTheDistanceToItsArc) {
  const Surface phantom = sheet(0.025, 0.050, 0.001);
  const Field distance = distance_of(
      phantom,
      Horseshoe{.centre_m = {0.010, 0.020, 0.0}, .arc_radius_m = 0.006, .half_width_m = 0.002});
  EXPECT_NEAR(at_mm(phantom, distance, 16, 20), 0.002, 1e-15);
  EXPECT_NEAR(at_mm(phantom, distance, 10, 20), -0.004,
              1e-15);  // the centre: 6 mm from the whole arc
  EXPECT_NEAR(at_mm(phantom, distance, 10, 26), 0.002, 1e-15);
  EXPECT_NEAR(at_mm(phantom, distance, 8, 26), 0.0, 1e-15);  // the round cap at the end
  EXPECT_NEAR(at_mm(phantom, distance, 7, 10), -0.003,
              1e-15);  // 3 to the left of and 4 below the lower end: 2 - 5
  EXPECT_NEAR(at_mm(phantom, distance, 0, 20), 0.002 - std::hypot(0.010, 0.006), 1e-15);
}

// Facing up the solid part is above the centre; a whole circle of arc is a ring.
TEST(SignedDistance, OfAHorseshoeFollowsFacingAndArc) {
  const Surface phantom = sheet(0.025, 0.050, 0.001);
  Horseshoe up{.centre_m = {0.012, 0.020, 0.0},
               .arc_radius_m = 0.006,
               .half_width_m = 0.002,
               .facing = {0.0, 3.0, 1.0}};
  const Field above = distance_of(phantom, up);
  EXPECT_NEAR(at_mm(phantom, above, 12, 26), 0.002, 1e-15);
  EXPECT_NEAR(at_mm(phantom, above, 12, 14), 0.002 - std::hypot(0.006, 0.006), 1e-15);
  up.arc_rad = 2.0 * std::numbers::pi;
  const Field ring = distance_of(phantom, up);
  for (const auto& [x, y] :
       {std::pair(12, 26), std::pair(12, 14), std::pair(6, 20), std::pair(18, 20)})
    EXPECT_NEAR(at_mm(phantom, ring, x, y), 0.002, 1e-15);
}

// An L with corners (5, 5), (15, 5), (15, 10), (10, 10), (10, 15), (5, 15) mm. Outlines are rounded
// to a picometre.
TEST(SignedDistance, OfAnOutlineIsTheDistanceToItsSidesPositiveBetweenThem) {
  const Surface phantom = sheet(0.020, 0.020, 0.001);
  Outline corner;
  for (const auto& [x, y] : {std::pair(5, 5), std::pair(15, 5), std::pair(15, 10),
                             std::pair(10, 10), std::pair(10, 15), std::pair(5, 15)}) {
    corner.points_m.emplace_back(1e-3 * x, 1e-3 * y, 0.0);
  }
  const Field distance = distance_of(phantom, corner);
  EXPECT_NEAR(at_mm(phantom, distance, 7, 8), 0.002, 1e-12);
  EXPECT_NEAR(at_mm(phantom, distance, 8, 9), std::hypot(0.002, 0.001),
              1e-12);  // from the corner that bends inwards
  EXPECT_NEAR(at_mm(phantom, distance, 13, 14), -0.003, 1e-12);  // in the notch
  EXPECT_NEAR(at_mm(phantom, distance, 2, 1), -0.005, 1e-12);    // 3 and 4 from the corner (5, 5)
  EXPECT_NEAR(at_mm(phantom, distance, 10, 5), 0.0, 1e-12);
  for (int x = 0; x <= 20; ++x) {
    for (int y = 0; y <= 20; ++y) {
      const bool is_inside = x > 5 && y > 5 && ((x < 15 && y < 10) || (x < 10 && y < 15));
      const bool is_outside = x < 5 || y < 5 || x > 15 || y > 15 || (x > 10 && y > 10);
      if (is_inside || is_outside) {
        EXPECT_EQ(at_mm(phantom, distance, x, y) > 0.0, is_inside) << x << ", " << y;
      }
    }
  }
}

TEST(SignedDistance, OfAnOutlineDoesNotDependOnItsDirectionOrOnRepeatedPoints) {
  const Surface phantom = sheet(0.020, 0.020, 0.001);
  const std::vector<Vec3> there = {{0.004, 0.004, 0.0}, {0.016, 0.005, 0.0}, {0.009, 0.017, 0.0}};
  const std::vector<Vec3> back = {there[2], there[1], there[1], there[0], there[2]};
  EXPECT_LT((distance_of(phantom, Outline{there}) - distance_of(phantom, Outline{back}))
                .cwiseAbs()
                .maxCoeff(),
            1e-15);  // rounding of centimetres
}

// Disks of 3 mm at x = 5 and 15 mm, y = 10: each is 3 mm deep in its middle, and half-way between
// them the tissue is 2 mm from both.
TEST(SignedDistance, OfSeveralTumoursIsTheGreatestOfTheirs) {
  const Surface phantom = sheet(0.020, 0.020, 0.001);
  const Disk left{.centre_m = {0.005, 0.010, 0.0}, .radius_m = 0.003},
      right{.centre_m = {0.015, 0.010, 0.0}, .radius_m = 0.003};
  const Field distance = signed_distance(phantom, std::vector<Tumour>{left, right});
  EXPECT_NEAR(at_mm(phantom, distance, 5, 10), 0.003, 1e-15);
  EXPECT_NEAR(at_mm(phantom, distance, 15, 10), 0.003, 1e-15);
  EXPECT_NEAR(at_mm(phantom, distance, 10, 10), -0.002, 1e-15);
}

TEST(SignedDistance, WithoutTumoursIsMinusInfinity) {
  const Surface phantom = sheet(0.002, 0.002, 0.001);
  EXPECT_TRUE((signed_distance(phantom, {}).array() == -kInfinity).all());
}

// The same disk on a sheet that stands upright, its normal along -y: only where it is in the plane
// counts.
TEST(SignedDistance, MovesWithTheTissue) {
  TriangleMesh mesh = sheet_mesh(0.025, 0.050, 0.001);
  const Surface flat(mesh);
  const auto stand_up = [](const Vec3& p) { return Vec3(p.x() + 0.1, -0.2, p.y() + 0.3); };
  for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i)
    mesh.vertices.row(i) = stand_up(mesh.vertices.row(i));
  const Surface upright(mesh);
  Horseshoe moved = kPaperHorseshoe;
  moved.centre_m = stand_up(kPaperHorseshoe.centre_m);
  moved.facing = Vec3(std::cos(0.5), 0.0, std::sin(0.5));
  Horseshoe turned = kPaperHorseshoe;
  turned.facing = Vec3(std::cos(0.5), std::sin(0.5), 0.0);
  const Field difference = distance_of(upright, moved) - distance_of(flat, turned);
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-14);  // rounding of decimetres
}

TEST(SignedDistance, OnPlanarTissueNeedsNoSearchTreeAndNoGeodesics) {
  const Surface phantom = sheet(0.025, 0.050, 0.001);
  const Outline triangle{{{0.004, 0.004, 0.0}, {0.016, 0.005, 0.0}, {0.009, 0.017, 0.0}}};
  signed_distance(phantom, std::vector<Tumour>{kPaperDisk, kPaperHorseshoe, triangle});
  EXPECT_TRUE(phantom.computed().empty());
}

// A sheet bent around a radius of 50 mm is developable: distances along it are those of the flat
// sheet. Chords of 1 mm are short by 1 mm^3 / (24 * 50^2) each, 2e-5 of the length, 0.6 um over 30
// mm.
TEST(SignedDistance, OfADiskOnABentSheetIsThatOnTheFlatOne) {
  const Surface flat = sheet(0.024, 0.024, 0.001), bent = bent_sheet(0.024, 0.024, 0.001, 0.050);
  const Disk disk{.centre_m = {0.012, 0.012, 0.0}, .radius_m = 0.006};
  EXPECT_LT((distance_of(bent, disk) - distance_of(flat, disk)).cwiseAbs().maxCoeff(), 1e-6);
}

// As above; the arc is drawn in the tangent plane and taken down to the sheet, so that 7 mm become
// 50 atan(7 / 50) = 6.954 mm across the bend. Sources are half an edge apart, 0.57 mm: half of that
// is the distance of a vertex on the arc.
TEST(SignedDistance, OfAHorseshoeOnABentSheetIsCloseToThatOnTheFlatOne) {
  const Surface flat = sheet(0.024, 0.024, 0.001), bent = bent_sheet(0.024, 0.024, 0.001, 0.050);
  const Horseshoe horseshoe{.centre_m = {0.012, 0.012, 0.0},
                            .arc_radius_m = 0.007,
                            .half_width_m = 0.0025,
                            .facing = {1.0, 0.0, 0.0}};
  const Field on_flat = distance_of(flat, horseshoe), on_bent = distance_of(bent, horseshoe);
  EXPECT_LT((on_bent - on_flat).cwiseAbs().maxCoeff(), 0.30e-3);
  for (int vertex = 0; vertex < flat.vertex_count(); ++vertex) {
    // On the outline, 2.5 mm from the arc, half a step counts hypot(2.5, 0.29) - 2.5 = 0.016 mm.
    if (std::abs(on_flat[vertex]) < 1e-3) {
      EXPECT_NEAR(on_bent[vertex], on_flat[vertex], 0.075e-3);
    }
  }
}

TEST(SignedDistance, NamesTheTumourAndTheRuleThatItBreaks) {
  const Surface phantom = sheet(0.025, 0.050, 0.001);
  Horseshoe horseshoe = kPaperHorseshoe;
  horseshoe.half_width_m = 0.008;
  EXPECT_EQ(message_of(phantom, {kPaperDisk, horseshoe}),
            "signed_distance: tumour 2: half width 0.008 m must be below the arc radius 0.007 m");
}

TEST(SignedDistance, RefusesShapesThatAreNone) {
  const Surface phantom = sheet(0.025, 0.050, 0.001);
  for (const double bad : {0.0, -0.001, kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    Disk disk = kPaperDisk;
    disk.radius_m = bad;
    EXPECT_THROW(distance_of(phantom, disk), InvalidInput) << bad;
    Horseshoe horseshoe = kPaperHorseshoe;
    horseshoe.half_width_m = bad;
    EXPECT_THROW(distance_of(phantom, horseshoe), InvalidInput) << bad;
    horseshoe = kPaperHorseshoe;
    horseshoe.arc_radius_m = bad;
    EXPECT_THROW(distance_of(phantom, horseshoe), InvalidInput) << bad;
    horseshoe = kPaperHorseshoe;
    horseshoe.arc_rad = bad;
    EXPECT_THROW(distance_of(phantom, horseshoe), InvalidInput) << bad;
  }
  Horseshoe up = kPaperHorseshoe;
  up.facing = Vec3::UnitZ();
  EXPECT_THROW(distance_of(phantom, up), InvalidInput);
}

// An hourglass, a line there and back, a point on another side, and two points.
TEST(SignedDistance, RefusesOutlinesThatCrossOrTouchThemselves) {
  const Surface phantom = sheet(0.020, 0.020, 0.001);
  const auto at = [](double x_mm, double y_mm) { return Vec3(1e-3 * x_mm, 1e-3 * y_mm, 0.0); };
  const std::vector<Outline> bad = {{{at(5, 5), at(15, 15), at(15, 5), at(5, 15)}},
                                    {{at(5, 5), at(15, 5), at(10, 5)}},
                                    {{at(5, 5), at(15, 5), at(15, 15), at(10, 5), at(5, 15)}},
                                    {{at(5, 5), at(15, 5), at(5, 5)}},
                                    {}};
  for (const Outline& outline : bad)
    EXPECT_THROW(distance_of(phantom, outline), InvalidInput)
        << outline.points_m.size() << " points";
}

// Five millimetres are allowed above the tissue and beside it, six are not.
TEST(SignedDistance, RefusesCentresFarFromTheTissue) {
  const Surface flat = sheet(0.025, 0.050, 0.001), bent = bent_sheet(0.025, 0.050, 0.0025, 0.050);
  for (const Surface& surface : {flat, bent}) {
    Disk disk{.centre_m = {0.0125, 0.030, 0.0049}, .radius_m = 0.006};
    EXPECT_NO_THROW(distance_of(surface, disk));
    disk.centre_m = Vec3(0.0125, 0.030, 0.006);
    EXPECT_THROW(distance_of(surface, disk), InvalidInput);
    disk.centre_m = Vec3(0.0125, 0.0549, 0.0);
    EXPECT_NO_THROW(distance_of(surface, disk));
    disk.centre_m = Vec3(0.0125, 0.056, 0.0);
    EXPECT_THROW(distance_of(surface, disk), InvalidInput);
    disk.centre_m = Vec3(kInfinity, 0.0, 0.0);
    EXPECT_THROW(distance_of(surface, disk), InvalidInput);
  }
}

// A disk around a place 2 mm beside the tissue is cut by the border: 3 mm of it reach in.
TEST(SignedDistance, LetsTheBorderCutATumour) {
  const Surface phantom = sheet(0.020, 0.020, 0.001);
  const Field distance =
      distance_of(phantom, Disk{.centre_m = {-0.002, 0.010, 0.0}, .radius_m = 0.005});
  EXPECT_NEAR(at_mm(phantom, distance, 0, 10), 0.003, 1e-15);
  EXPECT_NEAR(at_mm(phantom, distance, 3, 10), 0.0, 1e-15);
}

// A facet of the bent sheet spans a millimetre of arc, half of that past which its chord is shorter
// by 2e-8 m.
TEST(SignedDistance, OfAnOutlineOnABentSheetIsThatOnTheFlatOne) {
  constexpr double kRadius = 0.050, kMiddle = 0.010;
  const Surface flat = sheet(0.020, 0.020, 0.001), bent = bent_sheet(0.020, 0.020, 0.001, kRadius);
  const Outline outline{{{0.004, 0.004, 0.0}, {0.016, 0.005, 0.0}, {0.009, 0.017, 0.0}}};
  Outline rolled = outline;
  for (Vec3& point : rolled.points_m) {
    const double angle = (point.x() - kMiddle) / kRadius;
    point =
        Vec3(kMiddle + kRadius * std::sin(angle), point.y(), kRadius * std::cos(angle) - kRadius);
  }
  EXPECT_LT((distance_of(bent, rolled) - distance_of(flat, outline)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(SignedDistance, RefusesAnOutlineWhoseWaysCrossOnABentSheet) {
  const Outline bow{
      {{0.004, 0.004, 0.0}, {0.016, 0.016, 0.0}, {0.016, 0.004, 0.0}, {0.004, 0.016, 0.0}}};
  EXPECT_EQ(message_of(bent_sheet(0.020, 0.020, 0.001, 0.050), {bow}),
            "signed_distance: tumour 1: an outline whose sides 1 and 3 meet must not cross or "
            "touch itself");
}

/// Mean error of a geodesic disk's area on a sphere of radius R, relative to 2 pi R^2 (1 - cos(r /
/// R)), over some meshes.
double area_error_on_dome(double edge_m, int meshes) {
  constexpr double kSphere_m = 0.025, kDisk_m = 0.00625;
  const double area =
      2.0 * std::numbers::pi * kSphere_m * kSphere_m * (1.0 - std::cos(kDisk_m / kSphere_m));
  double mean = 0.0;
  Random random(1);
  for (int mesh = 0; mesh < meshes; ++mesh) {
    const Surface dome(make_phantom(dome_sheet({.reach_m = 0.009}), edge_m, 0.3, random).mesh);
    const Field distance =
        distance_of(dome, Disk{.centre_m = {0.0003, -0.0002, 0.0}, .radius_m = kDisk_m});
    mean += (superlevel_area(dome, distance, 0.0) / area - 1.0) / meshes;
  }
  return std::abs(mean);
}

TEST(SignedDistance, OfADiskOnADomeHasTheAreaOfTheClosedFormToSecondOrder) {
  const double coarse = area_error_on_dome(0.001, 16), middle = area_error_on_dome(0.0005, 8),
               fine = area_error_on_dome(0.00025, 4);
  EXPECT_LT(fine, 4e-4);
  EXPECT_NEAR(0.5 * std::log2(coarse / fine), 2.0, 0.1);
  EXPECT_NEAR(std::log2(coarse / middle), 2.0, 0.2);  // jitter
}

}  // namespace
}  // namespace palpation
