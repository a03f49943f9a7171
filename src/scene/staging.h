/// Where a run's files are written before they land together: a folder within the run's, so that
/// landing is renaming.
#pragma once

#include <filesystem>
#include <string>

namespace palpation::tool {

inline constexpr const char* kStagingName = ".palpate-partial";

class Staging {
 public:
  /// Makes the folder, without what a run that died left in it. Throws WriteError, also where there
  /// is something in it that no run writes.
  explicit Staging(const std::filesystem::path& folder);
  /// Takes it away with all that is in it, if that is possible.
  ~Staging();
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  /// Leaves it until the next run.
  void keep() { kept_ = true; }
  /// The same words without this folder's name: those of the file as it will be called.
  std::string without(std::string words) const;

 private:
  std::filesystem::path path_;
  bool kept_ = false;
};

}  // namespace palpation::tool
