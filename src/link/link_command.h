/// palpate link: a session, live, for 3D Slicer and whoever else speaks OpenIGTLink.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "link/link_server.h"

namespace palpation::link {

/// Which session.
struct LinkedSession {
  std::filesystem::path scene, folder;
  std::vector<std::string> overrides;
  std::string frame;  ///< RAS, LPS, or empty: as scene or mesh say
  bool quiet = false;
};

/// Serves until it is interrupted, which it throws. Throws IoError, WrongUsage and WriteError where
/// it cannot begin.
void link_session(const LinkedSession& session, const ServerOptions& options);

void add_link_command(CLI::App& app);

}  // namespace palpation::link
