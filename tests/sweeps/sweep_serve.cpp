// COUNT lines of callers that mean harm, or well, for `palpate serve`. Ends with 1 where one is not
// answered by a line of JSON, in words where it is refused.
//
// usage: sweep_serve COUNT SEED        a million take some minutes
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "palpation/session/session_state.h"
#include "tool/serve_lines.h"
#include "tool/server.h"

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr int kOneSession = 20'000;  // lines: what it says grows with it

struct Counts {
  int done = 0, refused = 0;
  std::size_t rows = 0;
};

/// Words of the first fault, or none.
std::string play(const fs::path& folder, int lines, palpation::Random& random, Counts& counts) {
  fs::remove_all(folder / "run");
  palpation::tool::Server server("");
  const std::string opening =
      json{{"do", "open"}, {"scene", folder / "scene.json"}, {"folder", folder / "run"}}.dump();
  for (int i = 0; i < lines; ++i) {
    const std::string line = palpation::tool::random_line(random, opening);
    const std::string text = server.answer(line);
    const json answer = json::parse(text, nullptr, false);
    const bool is_answer = answer.is_object() && answer.contains("ok") &&
                           answer["ok"].is_boolean() && text.find('\n') == std::string::npos;
    if (!is_answer) return line + "\n" + text;
    const bool is_done = answer["ok"].get<bool>();
    if (!is_done && answer.value("error", "").size() < 6) return line + "\n" + text;
    ++(is_done ? counts.done : counts.refused);
    if (i % 500 == 0) server.sync();
  }
  server.sync();
  if (fs::exists(folder / "run"))
    counts.rows += palpation::read_session(folder / "run").rows.size();
  return "";
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) return std::fprintf(stderr, "usage: sweep_serve COUNT SEED\n"), 2;
  const fs::path folder =
      fs::temp_directory_path() / ("palpation_sweep_serve_" + std::string(words[2]));
  fs::create_directories(folder);
  std::ofstream(folder / "scene.json") << R"({
    "surface": {"plane": {"size_mm": [20, 20], "vertices": [14, 14]}},
    "plan": {"initial": {"count": 9}, "batch": 4, "batches": 2},
    "robot": {"frame": "PSM1_base"}})";
  palpation::Random random(static_cast<std::uint64_t>(std::atoll(words[2])));
  Counts counts;
  int left = std::atoi(words[1]);
  std::string fault;
  for (; left > 0 && fault.empty(); left -= kOneSession)
    fault = play(folder, std::min(left, kOneSession), random, counts);
  fs::remove_all(folder);
  std::printf("%d lines done, %d refused in words, %zu rows in the journals%s%s\n", counts.done,
              counts.refused, counts.rows, fault.empty() ? "" : "; not answered:\n", fault.c_str());
  return fault.empty() && counts.done > 0 && counts.refused > 0 && counts.rows > 0 ? 0 : 1;
}
