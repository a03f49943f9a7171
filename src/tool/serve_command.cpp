#include "tool/serve_command.h"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <vector>

#include "palpation/base/error.h"
#include "scene/interrupt.h"
#include "tool/server.h"

namespace palpation::tool {
namespace {

constexpr std::size_t kLongestLine = std::size_t{1} << 20;

/// Bytes that came, cut into lines. One that is too long is an empty line that says so.
class Lines {
 public:
  struct Line {
    std::string text;
    bool is_too_long = false;
  };

  void add(std::string_view bytes) {
    for (std::size_t end = bytes.find('\n'); end != std::string_view::npos;
         end = bytes.find('\n')) {
      take(bytes.substr(0, end));
      finish();
      bytes.remove_prefix(end + 1);
    }
    take(bytes);
  }
  /// The last line of the input may have no end.
  void end() {
    if (!rest_.text.empty() || rest_.is_too_long) finish();
  }
  std::vector<Line> taken() { return std::exchange(whole_, {}); }

 private:
  void take(std::string_view bytes) {
    if (rest_.text.size() + bytes.size() > kLongestLine) {
      rest_.is_too_long = true;
      rest_.text.clear();
    }
    if (!rest_.is_too_long) rest_.text += bytes;
  }
  void finish() {
    if (!rest_.text.empty() && rest_.text.back() == '\r') rest_.text.pop_back();
    if (!rest_.text.empty() || rest_.is_too_long) whole_.push_back(std::move(rest_));
    rest_ = {};
  }

  std::vector<Line> whole_;
  Line rest_;
};

void write_out(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw WriteError("serve: cannot write to standard output");
}

/// What came together is on the disk before any of it is acknowledged.
void answer_all(Server& server, const std::vector<Lines::Line>& lines) {
  std::vector<std::string> answers;
  for (const Lines::Line& line : lines)
    answers.push_back(line.is_too_long ? R"({"error":"the line is longer than 1 MiB","ok":false})"
                                       : server.answer(line.text));
  try {
    server.sync();
  } catch (const WriteError& error) {
    for (std::string& answer : answers) answer = Server::not_synced(answer, error.what());
  }
  std::string text;
  for (const std::string& answer : answers) text += answer + "\n";
  write_out(text);
}

}  // namespace

void serve(const std::filesystem::path& folder) {
  Server server(folder);
  Lines lines;
  std::array<char, 1 << 16> bytes{};
  for (;;) {
    const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    check_interrupt();
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      throw IoError("serve: cannot read standard input: " + std::generic_category().message(errno));
    if (count == 0) lines.end();
    lines.add({bytes.data(), static_cast<std::size_t>(count)});
    if (const auto taken = lines.taken(); !taken.empty()) answer_all(server, taken);
    if (count == 0) return;
  }
}

}  // namespace palpation::tool
