/// Work on a thread whose stack would hold a few thousand frames only.
#pragma once

#include <pthread.h>

#include <functional>
#include <stdexcept>

namespace palpation::testing {

/// What the work throws is lost: it should say by what it writes that it came to its end.
inline void on_a_small_stack(std::function<void()> work) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr std::size_t kStack = 2 << 20;  // the sanitizers' own frames are larger
#else
  constexpr std::size_t kStack = 256 << 10;
#endif
  pthread_attr_t attributes;
  pthread_t thread;
  const auto run = [](void* argument) -> void* {
    try {
      (*static_cast<std::function<void()>*>(argument))();
    } catch (...) {
    }
    return nullptr;
  };
  if (pthread_attr_init(&attributes) != 0 || pthread_attr_setstacksize(&attributes, kStack) != 0 ||
      pthread_create(&thread, &attributes, run, &work) != 0) {
    throw std::runtime_error("no thread of a small stack");
  }
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
}

}  // namespace palpation::testing
