#include "boundary/quiet_cgal.h"

#include <CGAL/assertions.h>
#include <CGAL/assertions_behaviour.h>

#include <mutex>

namespace palpation {

namespace {

void say_nothing(const char*, const char*, const char*, int, const char*) {}

/// CGAL keeps its handlers once a process, so they are changed by the first guard and restored by
/// the last.
struct Handlers {
  std::mutex mutex;
  int guards = 0;
  CGAL::Failure_function error = nullptr;
  CGAL::Failure_function warning = nullptr;
  CGAL::Failure_behaviour on_error = CGAL::THROW_EXCEPTION;
  CGAL::Failure_behaviour on_warning = CGAL::CONTINUE;
};

Handlers& handlers() {
  static Handlers the_handlers;
  return the_handlers;
}

}  // namespace

QuietCgal::QuietCgal() {
  Handlers& saved = handlers();
  const std::lock_guard lock(saved.mutex);
  if (saved.guards++ > 0) return;
  saved.error = CGAL::set_error_handler(say_nothing);
  saved.warning = CGAL::set_warning_handler(say_nothing);
  saved.on_error = CGAL::set_error_behaviour(CGAL::THROW_EXCEPTION);
  saved.on_warning = CGAL::set_warning_behaviour(CGAL::CONTINUE);
}

QuietCgal::~QuietCgal() {
  Handlers& saved = handlers();
  const std::lock_guard lock(saved.mutex);
  if (--saved.guards > 0) return;
  CGAL::set_error_handler(saved.error);
  CGAL::set_warning_handler(saved.warning);
  CGAL::set_error_behaviour(saved.on_error);
  CGAL::set_warning_behaviour(saved.on_warning);
}

}  // namespace palpation
