#include "tool/register_command.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <memory>

#include "palpation/base/error.h"
#include "palpation/io/coordinates.h"
#include "palpation/io/csv.h"
#include "palpation/io/read_mesh.h"
#include "palpation/robot/registration.h"
#include "scene/registration_file.h"
#include "scene/single_file.h"
#include "scene/words.h"
#include "tool/option_checks.h"

namespace palpation::tool {
namespace {

constexpr double kMm = 1e3;        // in a metre
constexpr double kFits_m = 0.001;  // root mean square, of places that fit

struct RegisterArguments {
  std::filesystem::path mesh, touched, out;
  std::string unit;
  double touch_sd_mm = 0.2;
  bool refine = false;
  bool overwrite = false;
};

struct Touched {
  std::vector<TouchedPair> pairs;
  std::vector<Vec3> all;  ///< in the robot's frame
  std::string when;       ///< the last of them, UTC
};

/// The greatest of a column t of seconds since 1970, as ROS stamps are; without one, when the file
/// was written.
std::string when_touched(const CsvTable& table, const std::filesystem::path& path) {
  constexpr double kSince1970_s = 1e9;  // anything less is a clock of another kind
  std::time_t last = 0;
  const auto column = find_column(table, "t");
  for (std::size_t row = 0; column && row < table.row_count(); ++row) {
    const double t_s = number_at(table, row, *column).value_or(0.0);  // unknown where it is empty
    if (t_s > kSince1970_s && t_s < 1e11) last = std::max(last, static_cast<std::time_t>(t_s));
  }
  std::error_code none;
  const auto written = std::filesystem::last_write_time(path, none);
  if (last == 0)
    last = std::chrono::system_clock::to_time_t(
        std::chrono::time_point_cast<std::chrono::system_clock::duration>(
            std::chrono::file_clock::to_sys(written)));
  std::tm parts{};
  ::gmtime_r(&last, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

/// Rows with tissue_x, tissue_y and tissue_z are pairs; those where these are empty are anywhere.
Touched read_touched(const std::filesystem::path& path) {
  const CsvTable table = read_csv(path);
  Touched touched;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    Vec3 robot, tissue;
    int named = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string letter(1, "xyz"[axis]);
      robot[axis] = finite_number_at(table, row, column_index(table, letter));
      const auto column = find_column(table, "tissue_" + letter);
      if (!column || table.cell(row, *column).empty()) continue;
      tissue[axis] = finite_number_at(table, row, *column);
      ++named;
    }
    if (named != 0 && named != 3)
      fail_at_row(table, row, "a place on the tissue needs tissue_x, tissue_y and tissue_z");
    if (named == 3) touched.pairs.push_back({tissue, robot});
    touched.all.push_back(robot);
  }
  touched.when = when_touched(table, path);
  return touched;
}

Registration registered(const RegisterArguments& arguments, const Surface& surface,
                        const Touched& touched) {
  const double sd_m = arguments.touch_sd_mm / kMm;
  try {
    Registration registration = register_pairs(touched.pairs, sd_m);
    if (arguments.refine)
      registration = refine_on_surface(surface, touched.all, registration, sd_m);
    return registration;
  } catch (const InvalidInput& error) {
    throw IoError(arguments.touched.string() + ": " + error.what());
  }
}

/// Landmarks are on the tissue, or the pairs are of another mesh.
void check_landmarks(const RegisterArguments& arguments, const Surface& surface,
                     const std::vector<TouchedPair>& pairs) {
  constexpr double kFarthest_m = 0.005;
  for (const TouchedPair& pair : pairs) {
    const double off_m = (surface.position(surface.project(pair.tissue)) - pair.tissue).norm();
    if (off_m > kFarthest_m)
      throw IoError(arguments.touched.string() + ": the place " + place_words(pair.tissue, 1) +
                    " lies " + fixed(off_m * kMm, 1) +
                    " mm from the tissue: is it of this mesh, in metres?");
  }
}

/// Of places that fit badly; empty where all fit.
std::string doubt_words(const Registration& registration, const Touched& touched) {
  if (registration.rms_m <= kFits_m) return "";
  return "That is more than " + fixed(kFits_m * kMm, 0) + " mm: is every one of the " +
         counted(touched.pairs.size(), "pair") +
         " the same place in both frames, and was nothing moved?\n";
}

void register_tissue(const RegisterArguments& arguments) {
  const Surface surface(read_mesh(arguments.mesh, length_unit(arguments.unit)).mesh);
  const Touched touched = read_touched(arguments.touched);
  check_landmarks(arguments, surface, touched.pairs);
  const Registration registration = registered(arguments, surface, touched);
  const double uncertainty_m = uncertainty_along_normal_m(surface, registration);
  std::string words = counted(touched.all.size(), "place") + " touched, " +
                      counted(touched.pairs.size(), "pair") + ".\nOff by " +
                      fixed(registration.rms_m * kMm, 2) + " mm (root mean square):";
  for (const double one : registration.residuals_m) words += " " + fixed(one * kMm, 2);
  words += ".\n" + doubt_words(registration, touched) + "Along its normal the tissue lies within " +
           fixed(uncertainty_m * kMm, 2) +
           " mm of where it is taken to be, with 95 %,\nalong itself within " +
           fixed(uncertainty_along_surface_m(surface, registration) * kMm, 2) +
           " mm: a boundary's band is wider by that.\n";
  write_single_file(arguments.out, registration_document(registration, surface, touched.when),
                    arguments.overwrite ? Existing::Replaced : Existing::Kept);
  std::fputs(words.c_str(), stdout);
}

}  // namespace

void add_register_command(CLI::App& app) {
  const auto arguments = std::make_shared<RegisterArguments>();
  CLI::App* command =
      app.add_subcommand("register", "Where the tissue is, from places that the robot touched");
  command->add_option("MESH", arguments->mesh, "the tissue's mesh")->required();
  command
      ->add_option("--touched", arguments->touched,
                   "CSV: x,y,z where the robot's tip was, in its frame; tissue_x, tissue_y, "
                   "tissue_z the same place in the mesh's frame, metres, of three rows at least")
      ->required();
  command->add_option("--unit", arguments->unit, "of the mesh's coordinates: mm, cm or m")
      ->required()
      ->check(CLI::IsMember({"mm", "cm", "m"}));
  command->add_option("--out", arguments->out, "T.json, for robot.registration of a scene")
      ->required();
  command->add_flag("--refine", arguments->refine,
                    "then fit all places, six at least, to the surface: for tissue that curves");
  command
      ->add_option("--touch-sd-mm", arguments->touch_sd_mm,
                   "how well a place is touched at best; the residuals may say that it was worse")
      ->check(number(1e-4, 100.0));
  command->add_flag("--overwrite", arguments->overwrite, "replace another file of that name");
  command->callback([arguments] { register_tissue(*arguments); });
}

}  // namespace palpation::tool
