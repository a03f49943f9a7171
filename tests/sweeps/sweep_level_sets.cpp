// The laws of level sets on COUNT random fields: smooth, rough, stepped, flat in parts, one unit in
// the last place apart, huge, tiny and all of these mixed, at levels that vertices hit exactly and
// between, on planar and curved meshes of all kinds. Ends with 1 if a law is broken.
//
// usage: sweep_level_sets COUNT SEED        100,000 fields take some minutes
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "boundary/loop_laws.h"
#include "boundary/meshes.h"

namespace palpation {
namespace {

TriangleMesh jittered(TriangleMesh mesh, double jitter, Random& random) {
  for (double& coordinate : mesh.vertices.reshaped()) coordinate += jitter * random.normal();
  return mesh;
}

/// A plane without some of its cells.
TriangleMesh plane_with_holes(Random& random) {
  const int cells = 4 + random.below(7);
  Random shape = random.split();
  const TriangleMesh whole = make_plane(
      {.size_m = {1.0, 1.0}, .columns = cells + 1, .rows = cells + 1, .jitter = 0.3}, shape);
  const Vec3 hole(random.uniform(), random.uniform(), 0.0);
  const double radius = 0.3 * random.uniform();
  return testing::without_cells(whole, [&](const Vec3& p) { return (p - hole).norm() > radius; });
}

constexpr std::array kMeshes{"plane",
                             "plane with a hole",
                             "plane, tilted, scaled and far off",
                             "ball",
                             "torus",
                             "tube",
                             "dome with a hole",
                             "wavy sheet",
                             "ball and sheet",
                             "two sheets side by side",
                             "triangle",
                             "tent",
                             "octahedron",
                             "tetrahedron",
                             "two triangles back to back"};

TriangleMesh mesh_of_kind(std::size_t kind, Random& random) {
  const auto plane = [&](double jitter) {
    const int cells = 1 + random.below(12);
    return make_plane(
        {.size_m = {1.0, 1.0}, .columns = cells + 1, .rows = 1 + cells, .jitter = jitter}, random);
  };
  switch (kind) {
    case 0:
      return plane(0.45);
    case 1:
      return plane_with_holes(random);
    case 2: {
      const double scale = std::pow(10.0, 12.0 * random.uniform() - 9.0);
      return zoo::moved(plane(0.4), zoo::some_rotation(),
                        10.0 * scale * Vec3(random.uniform(), random.uniform(), random.uniform()),
                        scale);
    }
    case 3:
      return jittered(zoo::icosphere_mesh(random.below(3)), 0.02, random);
    case 4:
      return jittered(zoo::torus_mesh(2.0, 0.7, 4 + random.below(9), 4 + random.below(6)), 0.02,
                      random);
    case 5:
      return jittered(zoo::cylinder_mesh(1.0, 2.0, 3 + random.below(9), 1 + random.below(5)), 0.02,
                      random);
    case 6:
      return jittered(testing::dome_with_hole(6 + random.below(9), 2 + random.below(5)).mesh(),
                      0.01, random);
    case 7:
      return jittered(plane(0.3), 0.02, random);
    case 8:
      return zoo::together(zoo::icosphere_mesh(1),
                           zoo::moved(plane(0.3), zoo::some_rotation(), Vec3(3.0, 0.0, 0.0)));
    case 9:
      return zoo::together(
          plane(0.3), zoo::moved(plane(0.3), Eigen::Matrix3d::Identity(), Vec3(1.0, 0.25, 0.0)));
    case 10: {
      const TriangleMesh square = zoo::unit_square_mesh(1);
      return {square.vertices.topRows(3).eval(), (Triangles(1, 3) << 0, 1, 2).finished()};
    }
    case 11:
      return testing::fan(random.uniform()).mesh();
    case 12:
      return testing::octahedron().mesh();
    case 13:
      return zoo::tetrahedron_mesh();
    default: {
      const TriangleMesh square = zoo::unit_square_mesh(1);
      return {square.vertices.topRows(3).eval(), (Triangles(2, 3) << 0, 1, 2, 0, 2, 1).finished()};
    }
  }
}

/// A surface of that kind; jitter may spoil a mesh, then another is drawn.
Surface surface_of_kind(std::size_t kind, Random& random) {
  for (;;) {
    try {
      return Surface(mesh_of_kind(kind, random));
    } catch (const InvalidMesh&) {
    }
  }
}

constexpr std::array kFields{
    "smooth", "rough", "stepped",           "flat in parts", "an ulp apart",
    "huge",   "tiny",  "of all magnitudes", "constant",      "beside the level"};

Field field_of_kind(std::size_t kind, const Surface& surface, Random& random) {
  constexpr double kMost = std::numeric_limits<double>::max();
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  const auto each = [&](auto value) {
    return testing::field_of(surface, [&](const Vec3&) { return value(); });
  };
  switch (kind) {
    case 0:
      return testing::smooth_field(surface, random);
    case 1:
      return testing::rough_field(surface, random);
    case 2:
      return testing::stepped_field(surface, random);
    case 3:
      return (2.0 * testing::smooth_field(surface, random)).array().round();
    case 4:
      return each([&] { return 1.0 + std::numeric_limits<double>::epsilon() * random.below(4); });
    case 5:
      return each([&] {
        return kMost * (2.0 * random.uniform() - 1.0) * (random.below(2) == 0 ? 1.0 : 1e-308);
      });
    case 6:
      return each([&] { return kLeast * (random.below(7) - 3); });
    case 7:
      return each([&] {
        return (random.below(2) == 0 ? 1.0 : -1.0) *
               std::pow(10.0, 631.0 * random.uniform() - 323.0);
      });
    case 8:
      return Field::Constant(surface.vertex_count(), random.normal());
    default:
      return each([&] {
        return 1.0 + (random.below(2) == 0 ? 1.0 : -1.0) * std::pow(10.0, -16.0 * random.uniform());
      });
  }
}

double level_for(const Field& field, std::size_t kind, Random& random) {
  const double here = field[random.below(static_cast<int>(field.size()))];
  const double there = field[random.below(static_cast<int>(field.size()))];
  if (kind == 9) return 1.0;
  switch (random.below(8)) {
    case 0:
      return field.minCoeff();
    case 1:
      return field.maxCoeff();
    case 2:
      return std::nextafter(field.maxCoeff(), std::numeric_limits<double>::infinity()) <
                     std::numeric_limits<double>::infinity()
                 ? std::nextafter(field.maxCoeff(), std::numeric_limits<double>::infinity())
                 : field.maxCoeff();
    case 3:
    case 4:
      return here;
    case 5:
      return 0.0;
    default:
      return 0.5 * here + 0.5 * there;
  }
}

struct Worst {
  double value = 0.0;
  std::string where;
  void take(double candidate, const std::string& place) {
    if (candidate <= value) return;
    value = candidate;
    where = place;
  }
};

class Sweep {
 public:
  explicit Sweep(std::uint64_t seed) : random_(seed) {}

  void one(long number) {
    const auto mesh_kind =
        static_cast<std::size_t>(random_.below(static_cast<int>(kMeshes.size())));
    const Surface surface = surface_of_kind(mesh_kind, random_);
    for (int repeat = 0; repeat < kFieldsPerMesh; ++repeat) {
      const auto field_kind =
          static_cast<std::size_t>(random_.below(static_cast<int>(kFields.size())));
      const Field field = field_of_kind(field_kind, surface, random_);
      const double level = level_for(field, field_kind, random_);
      const std::string name = "mesh " + std::to_string(number) + ", " + kMeshes[mesh_kind] +
                               ", field " + std::to_string(repeat) + ", " + kFields[field_kind];
      try {
        check(surface, field, level, name);
      } catch (const Error& error) {
        fail(name, error.what());
      }
      ++fields_;
    }
  }

  int finish() const {
    std::printf("%ld fields, %ld regions, %ld pieces: %ld failures\n", fields_, regions_, pieces_,
                failures_);
    std::printf("loops' area less the triangles', of the surface's: worst %.3g (%s)\n", area_.value,
                area_.where.c_str());
    std::printf("region's area less the triangles', of the surface's: worst %.3g (%s)\n",
                region_.value, region_.where.c_str());
    std::printf("complement: worst %.3g (%s)\n", complement_.value, complement_.where.c_str());
    std::printf("nesting: worst %.3g (%s)\n", nesting_.value, nesting_.where.c_str());
    std::printf("points beside the marched line, of the diameter: worst %.3g (%s)\n", shift_.value,
                shift_.where.c_str());
    std::printf("pieces between equal coordinates: %ld\n", coincident_);
    return failures_ == 0 ? 0 : 1;
  }

  static constexpr int kFieldsPerMesh = 10;

 private:
  /// On these small meshes, at most ten diameters from the origin: hundreds of terms and a rounding
  /// of 1e-15 of the diameter at each corner.
  static constexpr double kRounding = 1e-12;

  void check(const Surface& surface, const Field& field, double level, const std::string& name) {
    const std::vector<LevelLoop> loops = level_loops(surface, field, level);
    const testing::LoopReport report = testing::report_on_loops(surface, field, level, loops);
    if (!report.fault.empty()) fail(name, report.fault);
    pieces_ += report.pieces;
    coincident_ += report.coincident;
    note(report.area_difference, area_, name);
    note(report.shift, shift_, name);

    const double area = superlevel_area(surface, field, level);
    note(std::abs(area + superlevel_area(surface, -field, -level) - area_at(surface, field, level) -
                  surface.area()) /
             surface.area(),
         complement_, name);
    const double higher = level + std::abs(level) * random_.uniform();
    if (std::isfinite(higher))
      note((superlevel_area(surface, field, higher) - area) / surface.area(), nesting_, name);
    if (!surface.has_chart()) return;
    ++regions_;
    const Region region = superlevel_region(surface, field, level);
    note(std::abs(surface_area(surface, region) - area) / surface.area(), region_, name);
    if (regions_ % 10 == 0 && std::isfinite(higher)) {
      note(subtract(superlevel_region(surface, field, higher), region).area() / surface.area(),
           nesting_, name);
    }
    if (regions_ % 10 == 5) {
      const Region below = superlevel_region(surface, -field, -level);
      note(std::abs(surface_area(surface, intersect(region, below)) -
                    area_at(surface, field, level)) /
               surface.area(),
           complement_, name);
    }
  }

  /// Of the faces that are at the level: they are inside both ways.
  static double area_at(const Surface& surface, const Field& field, double level) {
    double sum = 0.0;
    for (int face = 0; face < surface.face_count(); ++face) {
      const Eigen::Vector3i t = surface.triangle(face);
      if (field[t[0]] == level && field[t[1]] == level && field[t[2]] == level)
        sum += surface.face_area(face);
    }
    return sum;
  }

  void note(double difference, Worst& worst, const std::string& name) {
    worst.take(difference, name);
    if (difference > kRounding) fail(name, "off by " + text_of(difference));
  }

  void fail(const std::string& name, const std::string& law) {
    if (++failures_ <= 20) std::printf("FAILED: %s: %.500s\n", name.c_str(), law.c_str());
  }

  Random random_;
  long fields_ = 0, regions_ = 0, pieces_ = 0, failures_ = 0, coincident_ = 0;
  Worst area_, region_, complement_, nesting_, shift_;
};

}  // namespace
}  // namespace palpation

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: sweep_level_sets COUNT SEED\n", stderr);
    return 2;
  }
  const long count = std::atol(argv[1]);
  palpation::Sweep sweep(std::strtoull(argv[2], nullptr, 10));
  for (long done = 0; done < count; done += palpation::Sweep::kFieldsPerMesh)
    sweep.one(done / palpation::Sweep::kFieldsPerMesh);
  return sweep.finish();
}
