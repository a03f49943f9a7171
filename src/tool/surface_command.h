/// `palpate mesh surface`: tissue from contact points.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace palpation::tool {

/// What the contacts are, and where they come from.
struct ContactArguments {
  std::filesystem::path points;
  std::string unit;                  ///< empty: by the names of the columns
  std::vector<std::string> columns;  ///< three, or none
  std::vector<std::string> normals;  ///< three, or none
  std::vector<double> up;            ///< three, or none
};

struct SurfaceArguments {
  ContactArguments contacts;
  double edge_mm = 0.0, gap = 4.0, noise_mm = 0.0;  ///< 0: by the sampling, or learned
  std::string by = "auto";
  std::filesystem::path output;
  bool overwrite = false;  ///< another file of that name
};

void make_surface(const SurfaceArguments& arguments);

/// Adds the command to `palpate mesh`.
void add_surface_command(CLI::App& mesh);

}  // namespace palpation::tool
