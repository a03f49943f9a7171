/// A session on a scene as Python holds it: open, or closed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpation/session/session.h"
#include "python/concluded.h"
#include "scene/tissue.h"

namespace palpation::python {

struct SceneAsked {
  std::filesystem::path path{};          ///< of a file, or empty
  std::string text{};                    ///< JSON, where there is no file
  std::vector<std::string> overrides{};  ///< "KEY=VALUE" each
};

/// What a session is told: a reading, or a stop that could not be touched.
struct Told {
  SessionReading made{};  ///< kind Missed: only its stop counts
  std::string why{};      ///< of a stop that could not be touched
};

class OpenSession {
 public:
  /// Throws as Scene, tissue_of and Session do.
  OpenSession(const SceneAsked& asked, std::filesystem::path folder, bool anyway);

  const Surface& surface() const { return tissue_.surface; }
  const std::filesystem::path& folder() const { return folder_; }
  /// Of the scene and its tissue, and what was noticed on opening.
  const std::vector<std::string>& remarks() const { return remarks_; }
  Session& session() { return session_; }
  const SessionState& state() const { return session_.state(); }

  /// All of it, synced, or nothing: throws InvalidInput, naming the row, before anything is taken.
  std::vector<Recorded> record(const std::vector<Told>& told);
  /// As `palpate boundary` concludes of the session's export.
  Concluded conclude() const;

 private:
  void check_all(const std::vector<Told>& told) const;

  std::filesystem::path folder_;
  tool::Scene scene_;
  tool::Tissue tissue_;
  Session session_;
  std::vector<std::string> remarks_;
};

/// The lines of a folder's journal, JSON each, its writer running or not. Throws IoError, naming
/// the line, where one is corrupted.
std::vector<std::string> journal_lines(const std::filesystem::path& folder);

}  // namespace palpation::python
