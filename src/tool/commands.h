/// The tool's commands. Each prints its result in plain words and throws what goes wrong.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palpation::tool {

/// What every command on a scene takes.
struct SceneArguments {
  std::filesystem::path scene;
  std::vector<std::string> overrides;
  std::optional<std::uint64_t> seed;
  std::filesystem::path out;  ///< empty: nothing is written
  bool overwrite = false;     ///< another run's results there
  bool quiet = false;
};

struct InfoArguments {
  std::filesystem::path
      file;  ///< a mesh, or a scene (.json), whose tissue is looked at as it is cut out and refined
  std::string unit;                    ///< of a mesh: it must be given
  std::vector<std::string> overrides;  ///< of a scene
};

struct MeshArguments {
  std::string kind = "plane";     ///< of mesh_kinds()
  std::vector<double> size_mm{};  ///< empty: 25 x 50
  std::vector<int> vertices{};    ///< empty: 200 x 200
  double jitter = 0.0;
  std::filesystem::path around;  ///< span this recording instead
  double margin_mm = 0.0;
  std::optional<double> edge_mm{};  ///< of a plane instead of `vertices`; else half a millimetre
  // Of the curved phantoms; what is left out is as in make_phantom.h.
  std::optional<double> radius_mm, reach_mm, amplitude_mm, wavelength_mm, gap_mm, flank_mm;
  std::uint64_t seed = 1;
  std::string unit = "mm";
  std::filesystem::path output;
  bool overwrite = false;  ///< another mesh
};

void simulate(const SceneArguments& arguments);
/// An empty path: nothing was measured yet.
void plan(const SceneArguments& arguments, const std::filesystem::path& measurements);
void boundary(const SceneArguments& arguments, const std::filesystem::path& measurements);
void replay(const SceneArguments& arguments, const std::vector<std::filesystem::path>& recordings);
void compare_boundaries(const SceneArguments& arguments, const std::filesystem::path& a,
                        const std::filesystem::path& b);
void info(const InfoArguments& arguments);
void make_mesh(const MeshArguments& arguments);
/// The phantoms that there are.
std::vector<std::string> mesh_kinds();

}  // namespace palpation::tool
