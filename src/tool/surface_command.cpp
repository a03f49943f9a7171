// mesh surface: tissue from where a probe met it.
#include "tool/surface_command.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <vector>

#include "geometry/self_intersection.h"
#include "palpation/base/contract.h"
#include "palpation/belief/height.h"
#include "palpation/geometry/reconstruct.h"
#include "palpation/geometry/surface.h"
#include "palpation/io/contacts.h"
#include "palpation/io/read_mesh.h"
#include "scene/exit_code.h"
#include "scene/mesh_words.h"
#include "scene/single_file.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

constexpr int kNamed = 10;        // outliers that are named one by one
constexpr double kUpright = 0.5;  // cosine: a plane may lean by 60 degrees from +z

std::string mm(double length_m, int digits = 2) {
  char words[64];
  std::snprintf(words, sizeof words, "%.*f", digits, 1e3 * length_m);
  return words;
}

void print(const std::string& line) { std::printf("%s\n", line.c_str()); }

[[noreturn]] void refuse(const std::string& words) { throw WrongUsage("mesh surface: " + words); }

void check(const SurfaceArguments& arguments) {
  if (arguments.output.extension() != ".ply")
    refuse("OUT must end with .ply: no other format has a place for height_sd");
  const auto at_least = [](const char* name, double value, double least) {
    if (!std::isfinite(value) || value < least)
      refuse(std::string(name) + " " + text_of(value) + " must be at least " + text_of(least));
  };
  at_least("--edge-mm", arguments.edge_mm, 0.0);
  at_least("--gap", arguments.gap, 1.5);
  at_least("--noise-mm", arguments.noise_mm, 0.0);
  const std::vector<double>& up = arguments.contacts.up;
  if (up.empty()) return;
  const Vec3 direction(up[0], up[1], up[2]);
  if (!direction.allFinite() || direction.isZero(0.0))
    refuse("--up must be a direction: three numbers, not all zero");
}

ContactsFile read(const ContactArguments& arguments) {
  ContactColumns columns{.position = arguments.columns, .outward = arguments.normals};
  if (!arguments.unit.empty()) columns.unit = length_unit(arguments.unit);
  ContactsFile file = read_contacts(arguments.points, columns);
  if (arguments.up.empty()) return file;
  const Vec3 up = Vec3(arguments.up[0], arguments.up[1], arguments.up[2]).stableNormalized();
  file.outward = up.transpose().replicate(file.points.rows(), 1);
  file.outward_from = "--up";
  return file;
}

/// Where nothing tells, what lies flat enough is taken to be touched from above; of what does not,
/// no side is guessed.
void assume_side(ContactsFile& file) {
  if (file.outward.rows() > 0) return;
  const Points centred = file.points.rowwise() - file.points.colwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(centred.transpose() * centred);
  if (std::abs(axes.eigenvectors()(2, 0)) < kUpright)
    refuse(
        "nothing tells from which side the probe came, and the contacts do not lie level: give "
        "--up, or --normals");
  file.outward = Vec3(0.0, 0.0, 1.0).transpose().replicate(file.points.rows(), 1);
  file.outward_from = "+z, which is assumed, as nothing tells: --up says otherwise";
}

Triangulation triangulation(const std::string& name) {
  if (name == "projection") return Triangulation::Projection;
  return name == "front" ? Triangulation::AdvancingFront : Triangulation::Chosen;
}

/// "3 outliers left out: lines 4, 9, 12".
std::string named(const std::vector<int>& contacts, const ContactsFile& file) {
  std::string words = " (" + file.place_word + (contacts.size() == 1 ? "" : "s");
  for (std::size_t i = 0; i < contacts.size() && i < kNamed; ++i)
    words +=
        (i == 0 ? " " : ", ") + std::to_string(file.places[static_cast<std::size_t>(contacts[i])]);
  if (contacts.size() > kNamed) words += ", ...";
  return words + ")";
}

double length_of(const Surface& surface, const std::vector<int>& loop) {
  double length = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i)
    length += (surface.vertex(loop[i]) - surface.vertex(loop[(i + 1) % loop.size()])).norm();
  return length;
}

/// Of each part the longest border is its rim: the others are holes.
void print_borders(const Surface& surface) {
  const Topology topology = surface.topology();
  std::vector<double> lengths;
  for (const std::vector<int>& loop : surface.border_loops())
    lengths.push_back(length_of(surface, loop));
  std::sort(lengths.rbegin(), lengths.rend());
  if (topology.components > 1)
    print("It has " + std::to_string(topology.components) + " parts that do not hang together.");
  const std::size_t rims = std::min(lengths.size(), static_cast<std::size_t>(topology.components));
  const std::size_t holes = lengths.size() - rims;
  if (lengths.empty()) return print("It is closed.");
  std::string words =
      holes == 0 ? "No holes" : std::to_string(holes) + (holes == 1 ? " hole, " : " holes, ");
  for (std::size_t i = rims; i < lengths.size(); ++i)
    words += (i == rims ? "" : ", ") + mm(lengths[i], 1);
  print(words + (holes == 0 ? "" : " mm around") + "; the rim is " + mm(lengths[0], 1) +
        " mm long.");
}

void print_fit(const HeightFit& fit, bool learned) {
  Field sorted = fit.height_sd;
  std::sort(sorted.begin(), sorted.end());
  print("Smoothed by a Gaussian process of the height, length " + mm(fit.learned.length_m, 1) +
        " mm: the surface may miss a contact by its noise, " + mm(fit.learned.noise_sd, 3) +
        " mm (standard deviation, " + (learned ? "learned" : "as asked for") +
        "); --noise-mm changes it.");
  print("How sure: height_sd " + mm(sorted[0], 3) + " to " + mm(sorted[sorted.size() - 1], 3) +
        " mm, median " + mm(sorted[sorted.size() / 2], 3) + " mm. A contact scatters by " +
        mm(fit.contact_sd, 3) + " mm about it.");
}

void print_left_out(const Reconstruction& rough, const HeightFit& fit, const ContactsFile& file) {
  std::vector<int> outliers = rough.outliers;
  outliers.insert(outliers.end(), fit.outliers.begin(), fit.outliers.end());
  std::sort(outliers.begin(), outliers.end());
  outliers.erase(std::unique(outliers.begin(), outliers.end()), outliers.end());
  if (!outliers.empty())
    print(std::to_string(outliers.size()) +
          (outliers.size() == 1 ? " contact lies far off its neighbours and was left out"
                                : " contacts lie far off their neighbours and were left out") +
          named(outliers, file) + ".");
  std::vector<int> beyond;
  std::set_difference(fit.beyond.begin(), fit.beyond.end(), outliers.begin(), outliers.end(),
                      std::back_inserter(beyond));
  if (!beyond.empty())
    print(std::to_string(beyond.size()) + (beyond.size() == 1 ? " contact lies" : " contacts lie") +
          " beyond the rim, too far from others to be joined" + named(beyond, file) + ".");
}

void print_points(const SurfaceArguments& arguments, const ContactsFile& file,
                  const Reconstruction& rough) {
  print("From " + std::to_string(file.points.rows()) + " contacts (" + file.unit_words + "), " +
        mm(rough.spacing_m) + " mm apart" +
        (rough.thinned_m > 0.0
             ? "; to join them, those within " + mm(rough.thinned_m) + " mm were averaged"
             : "") +
        ".");
  for (const std::string& remark : file.remarks) print(remark);
  print(std::string("Joined ") +
        (rough.by == Triangulation::Projection ? "as seen along one direction"
                                               : "in space, by an advancing front") +
        "; gaps wider than " + text_of(arguments.gap) + " such distances, " +
        mm(arguments.gap * rough.spacing_m, 1) + " mm, stay open. Outward by " + file.outward_from +
        ".");
}

/// Boundaries are drawn on what can be laid flat.
void print_whether_flat(const Surface& surface) {
  try {
    surface.chart();
  } catch (const InvalidInput& error) {
    print("Warning: no boundary can be drawn on all of it: " + rule_words(error) +
          ". A wider --gap closes holes and notches of the rim; of a slide, the readings that "
          "palpate readings makes of it are better contacts than its log.");
  }
}

}  // namespace

void make_surface(const SurfaceArguments& arguments) {
  check(arguments);
  ContactsFile file = read(arguments.contacts);
  refuse_to_replace(arguments.output, arguments.overwrite ? Existing::Replaced : Existing::Kept);
  assume_side(file);
  const Reconstruction rough = reconstruct(
      file.points, file.outward,
      {.by = triangulation(arguments.by), .gap = arguments.gap, .edge_m = arguments.edge_mm / 1e3});
  const HeightFit fit = fit_height(Surface(rough.mesh), file.points,
                                   {.spacing_m = rough.spacing_m,
                                    .reach_m = rough.spacing_m,
                                    .noise_sd_m = arguments.noise_mm / 1e3});
  const Surface surface(fit.mesh);
  write_mesh(arguments.output, fit.mesh, LengthUnit::Millimetre, fit.height_sd);
  print(arguments.output.string() + ": " + std::to_string(surface.vertex_count()) + " vertices, " +
        std::to_string(surface.face_count()) + " triangles, mm; " + size_words(fit.mesh));
  print_points(arguments, file, rough);
  print_borders(surface);
  print_fit(fit, arguments.noise_mm == 0.0);
  print_left_out(rough, fit, file);
  const SelfIntersections crossings = self_intersections(surface);
  if (crossings.pairs > 0)
    print("Warning: it runs through itself at " + std::to_string(crossings.pairs) +
          " pairs of triangles: contacts are too sparse there, or steep. More --noise-mm or a "
          "longer --edge-mm may help.");
  print_whether_flat(surface);
  print("Next: palpate info " + arguments.output.string() + " --unit mm");
}

}  // namespace palpation::tool
