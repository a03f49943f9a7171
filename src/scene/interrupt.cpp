#include "scene/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <ctime>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "scene/exit_code.h"

namespace palpation::tool {
namespace {

constexpr std::time_t kPatience_s = 2;

std::atomic<int> received{0};
std::mutex last_words_guard;
std::function<void()> last_words;

std::string name_of(int signal) {
  return signal == SIGINT ? "SIGINT (Ctrl-C)" : signal == SIGTERM ? "SIGTERM" : "SIGHUP";
}

/// Files are renamed only when they are whole, so nothing is half-written.
[[noreturn]] void end_at_once() {
  const std::lock_guard lock(last_words_guard);
  if (last_words) last_words();
  const std::string words =
      "\npalpate: " + std::string(Interrupted(name_of(received)).what()) + "\n";
  [[maybe_unused]] const ssize_t told = ::write(STDERR_FILENO, words.data(), words.size());
  ::_exit(kInterrupted);
}

void wait_for_signal(sigset_t watched) {
  int signal = 0;
  if (::sigwait(&watched, &signal) != 0) return;
  received = signal;
  const timespec patience{.tv_sec = kPatience_s, .tv_nsec = 0};
  ::sigtimedwait(&watched, nullptr, &patience);
  end_at_once();
}

}  // namespace

void watch_for_interrupt() {
  sigset_t watched;
  ::sigemptyset(&watched);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct ::sigaction now {};
    ::sigaction(signal, nullptr, &now);
    if (signal == SIGHUP && now.sa_handler == SIG_IGN) continue;
    std::signal(signal, SIG_DFL);  // what is ignored would never be waited for
    ::sigaddset(&watched, signal);
  }
  ::pthread_sigmask(SIG_BLOCK, &watched, nullptr);
  try {
    std::thread(wait_for_signal, watched).detach();
  } catch (const std::system_error&) {
    // No thread is to be had: they end the program as they end any.
    ::pthread_sigmask(SIG_UNBLOCK, &watched, nullptr);
  }
}

bool is_interrupted() { return received != 0; }

void check_interrupt() {
  if (is_interrupted()) throw Interrupted(name_of(received));
}

LastWords::LastWords(std::function<void()> say) {
  const std::lock_guard lock(last_words_guard);
  last_words = std::move(say);
}

LastWords::~LastWords() {
  const std::lock_guard lock(last_words_guard);
  last_words = nullptr;
}

}  // namespace palpation::tool
