// GLEW as Debian builds it looks for GLX first. Without an X display its glewInit() has loaded
// every entry point when it reports that there is no GLX, and VTK gives up although all that it
// needs is there. This definition comes before the library's (the program exports its symbols) and
// forgives that one report.
#include <dlfcn.h>

namespace {

constexpr unsigned kGlewOk = 0;
constexpr unsigned kGlewNoGlxDisplay = 4;

}  // namespace

extern "C" unsigned glewInit() {
  using Function = unsigned (*)();
  const auto genuine = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "glewInit"));
  if (genuine == nullptr) return 1;
  const unsigned result = genuine();
  return result == kGlewNoGlxDisplay ? kGlewOk : result;
}
