#include "scene/draw_program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "scene/interrupt.h"
#include "scene/stopwatch.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

constexpr double kPatience_s = 120.0;  // an organ of a million triangles takes a few seconds
constexpr int kTick_ms = 20;
constexpr std::size_t kMostWords = 4096;
constexpr int kNotStarted = 127;

/// Between fork and exec only what is safe there. Signals that this program waits for are blocked
/// in it, and must not be in the other.
[[noreturn]] void become(const std::vector<char*>& words, int error_stream, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kNotStarted);  // it ended before it could be watched
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
  ::dup2(error_stream, STDERR_FILENO);
  ::execv(words.front(), words.data());
  ::_exit(kNotStarted);
}

/// A process that was started, and what it says on its error stream.
class Child {
 public:
  Child(pid_t number, int stream) : number_(number), stream_(stream) {}
  ~Child() {
    ::close(stream_);
    if (number_ <= 0) return;
    ::kill(number_, SIGKILL);
    ::waitpid(number_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// How it ended, if it did. Waits for a moment.
  std::optional<int> ended() {
    listen(kTick_ms);
    int status = 0;
    if (::waitpid(number_, &status, WNOHANG) != number_) return std::nullopt;
    number_ = 0;
    while (open_ && said_.size() < kMostWords && listen(0)) continue;
    return status;
  }

  std::string said() const { return said_.substr(0, said_.find_last_not_of('\n') + 1); }

 private:
  /// Whether there was something to hear.
  bool listen(int patience_ms) {
    pollfd watched{.fd = open_ ? stream_ : -1, .events = POLLIN, .revents = 0};
    if (::poll(&watched, 1, patience_ms) <= 0) return false;
    std::array<char, 512> bytes{};
    const ssize_t count = ::read(stream_, bytes.data(), bytes.size());
    open_ = count > 0;
    if (open_ && said_.size() < kMostWords)
      said_.append(bytes.data(), static_cast<std::size_t>(count));
    return open_;
  }

  pid_t number_;
  int stream_;
  bool open_ = true;
  std::string said_;
};

std::optional<std::string> reason_of(int status, const std::string& said, const std::string& name) {
  if (WIFSIGNALED(status))
    return "the graphics stack failed (signal " + std::to_string(WTERMSIG(status)) + ")";
  if (WEXITSTATUS(status) == 0) return std::nullopt;
  if (WEXITSTATUS(status) == kNotStarted) return name + " cannot be started";
  return said.empty() ? name + " failed" : said;
}

}  // namespace

std::optional<std::string> run_helper(const std::filesystem::path& program,
                                      const std::vector<std::string>& arguments,
                                      double patience_s) {
  const std::string name = program.filename().string();
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& one : words) pointers.push_back(one.data());
  pointers.push_back(nullptr);

  std::array<int, 2> channel{};
  if (::pipe2(channel.data(), O_CLOEXEC) != 0) return "no pipe to " + name;
  const pid_t self = ::getpid();
  const pid_t number = ::fork();
  if (number == 0) become(pointers, channel[1], self);
  ::close(channel[1]);
  Child child(number, channel[0]);
  if (number < 0) return name + " cannot be started";
  const Stopwatch waiting;
  while (waiting.seconds() < patience_s) {
    if (const std::optional<int> status = child.ended())
      return reason_of(*status, child.said(), name);
    if (is_interrupted()) return "interrupted";
  }
  return name + " did not end within " + fixed(patience_s, patience_s < 10.0 ? 1 : 0) +
         " s, and was ended";
}

std::optional<std::string> run_draw(const std::vector<std::string>& arguments) {
  std::error_code failure;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", failure);
  const std::filesystem::path program = self.parent_path() / "palpate-draw";
  if (failure || ::access(program.c_str(), X_OK) != 0)
    return "the program palpate-draw does not lie beside palpate";
  std::vector<std::string> words = arguments;
  words.emplace_back("--overwrite");  // what may be replaced was looked at before
  return run_helper(program, words, kPatience_s);
}

}  // namespace palpation::tool
