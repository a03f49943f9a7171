/// What `palpate serve` answers: a session and its gate, a JSON line each way.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "palpation/robot/gate.h"
#include "palpation/session/session.h"
#include "scene/scene.h"
#include "tool/request.h"

namespace palpation::tool {

/// Laws: every line has one answer, in order, in words where it is refused; nothing that a line
/// says ends the program; an answer is true once sync() has returned after it.
class Server {
 public:
  /// `folder`: where open's is left out; may be empty.
  explicit Server(std::filesystem::path folder);
  ~Server();

  /// The answer to a line, without line ends. To be held back until sync().
  std::string answer(std::string_view line);
  /// What was answered is on the disk. Throws WriteError; then the session is closed.
  void sync();
  /// The answer that takes the place of one that was not synced.
  static std::string not_synced(const std::string& answer, const std::string& why);

 private:
  struct Run;

  nlohmann::json act(Request& request);
  nlohmann::json open(Request& request);
  nlohmann::json close(Request& request);
  nlohmann::json next(Request& request);
  nlohmann::json record(Request& request);
  nlohmann::json hand(const std::string& what, Request& request);
  nlohmann::json conclude(Request& request);
  nlohmann::json gate(Request& request);
  nlohmann::json acknowledge(Request& request);
  Run& run();
  /// Closes it. What its gate holds for the next one holds for, too.
  std::unique_ptr<Run> left_run();
  Gate& gate_of_run();
  GateStop stop_asked(Request& request);

  std::filesystem::path folder_;
  std::unique_ptr<Run> run_;
  std::string held_for_;  ///< by a gate that is no more, until there is another
  std::string lost_;      ///< why what was closed is not on the disk
  std::size_t lines_ = 0;
};

}  // namespace palpation::tool
