#include "world/draft.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kMargin_m = 0.002;
constexpr double kLeastArea_m2 = 0.5e-4, kMostArea_m2 = 4e-4;
constexpr double kNodule_m = 0.0045;  // radius
constexpr double kGap_m = 0.002;
constexpr double kSmooth_m = 0.0015;  // least reach of an outline without corners
constexpr int kMostDraws = 10'000;

RandomShapeOptions shape_options(const Draft& draft, double least_reach_m) {
  const Vec2 room = draft.area.size_m.array() - 2.0 * kMargin_m;
  const double most = std::min(kMostArea_m2, 0.25 * room.prod());
  return {.size_m = draft.area.size_m,
          .margin_m = kMargin_m,
          .least_area_m2 = std::min(kLeastArea_m2, most),
          .most_area_m2 = most,
          .least_reach_m = least_reach_m};
}

}  // namespace

Vec3 Draft::anywhere(double margin_m) {
  const Vec2 room = area.size_m.array() - 2.0 * margin_m;
  require(room.minCoeff() > 0.0, "draw_world",
          "tissue of " + text_of(area.size_m.x()) + " x " + text_of(area.size_m.y()) + " m",
          "must leave " + text_of(margin_m) + " m on every side");
  const double x = random.uniform(), y = random.uniform();
  return {margin_m + x * room.x(), margin_m + y * room.y(), 0.0};
}

Vec3 Draft::direction() {
  const double angle = between(0.0, 2.0 * std::numbers::pi);
  return {std::cos(angle), std::sin(angle), 0.0};
}

Lump& Draft::add(Tumour outline) {
  Lump& lump = world.design.lumps.emplace_back();
  lump.outline = std::move(outline);
  return lump;
}

Lump& add_shape(Draft& draft, ShapeFamily family) {
  const bool is_smooth =
      family == ShapeFamily::Star || family == ShapeFamily::Bent || family == ShapeFamily::Ellipse;
  const double reach_m = is_smooth ? kSmooth_m : 0.0;
  return draft.add(random_shape(family, draft.random, shape_options(draft, reach_m)));
}

Lump& add_blob(Draft& draft) { return add_shape(draft, ShapeFamily::Star); }

Lump& add_disk(Draft& draft, double least_m, double most_m) {
  const double radius_m = draft.between(least_m, most_m);
  return draft.add(Disk{draft.anywhere(radius_m + kMargin_m), radius_m});
}

void add_ring(Draft& draft) {
  Horseshoe ring{.arc_radius_m = draft.between(0.0048, 0.0065),
                 .half_width_m = draft.between(0.0018, 0.0025),
                 .arc_rad = 2.0 * std::numbers::pi};
  ring.centre_m = draft.anywhere(ring.arc_radius_m + ring.half_width_m + 0.0005);
  draft.add(ring);
}

void add_over_border(Draft& draft) {
  const double radius_m = draft.between(0.005, 0.008);
  Vec3 centre = draft.anywhere(radius_m);
  centre[draft.area.size_m.x() < draft.area.size_m.y() ? 0 : 1] = 0.0;
  draft.add(Disk{centre, radius_m});
}

void add_nodules(Draft& draft, int count) {
  std::vector<Vec3> centres;
  for (int draw = 0; static_cast<int>(centres.size()) < count; ++draw) {
    require(draw < kMostDraws, "draw_world", std::to_string(count) + " nodules",
            "must fit on the tissue");
    if (draw % 100 == 99) centres.clear();
    const Vec3 centre = draft.anywhere(kNodule_m + 0.001);
    const bool is_apart = std::ranges::all_of(centres, [&](const Vec3& other) {
      return (other - centre).norm() >= 2.0 * kNodule_m + kGap_m;
    });
    if (is_apart) centres.push_back(centre);
  }
  for (const Vec3& centre : centres) draft.add(Disk{centre, kNodule_m});
}

void add_touching(Draft& draft, double contrast) {
  const double radius_m = draft.between(0.0035, 0.005), other_m = draft.between(0.0035, 0.005);
  const double apart_m = draft.between(0.7, 0.95) * (radius_m + other_m);
  const Vec3 middle = draft.anywhere(0.5 * (apart_m + radius_m + other_m)),
             half = 0.5 * apart_m * draft.direction();
  draft.add(Disk{middle - half, radius_m});
  draft.add(Disk{middle + half, other_m}).contrast = contrast;
}

void add_cored(Draft& draft, double contrast) {
  const double radius_m = draft.between(0.006, 0.008),
               core_m = radius_m - draft.between(0.0025, 0.004);
  const Vec3 centre = draft.anywhere(radius_m + 0.001);
  draft.add(Disk{centre, radius_m}).contrast = contrast;
  draft.add(Disk{centre + 0.5 * (radius_m - core_m) * draft.direction(), core_m});
}

void add_vessel(Draft& draft, double height) {
  const Vec3 middle = draft.anywhere(0.006), along = draft.direction();
  const double far = draft.area.size_m.norm();
  const Vec3 side(-along.y(), along.x(), 0.0);
  const double bend = draft.between(-0.15, 0.15);
  draft.world.design.background.push_back(
      Vessel{.height = height,
             .half_width_m = draft.between(0.0008, 0.0015),
             .line_m = {middle - far * along + bend * far * side, middle,
                        middle + far * along + bend * far * side}});
}

void add_wave(Draft& draft, double height) {
  draft.world.design.background.push_back(Wave{.height = height,
                                               .length_m = draft.between(0.02, 0.05),
                                               .direction = draft.direction(),
                                               .phase_rad = draft.between(0.0, 6.283)});
}

void add_tilt(Draft& draft) {
  draft.world.design.background.push_back(
      Tilt{.height = draft.between(0.3, 1.5), .direction = draft.direction()});
}

}  // namespace palpation
