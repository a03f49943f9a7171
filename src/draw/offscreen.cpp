#include "draw/offscreen.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <X11/Xlib.h>
#include <vtkCallbackCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <cstdlib>

namespace palpation::draw {
namespace {

class SilentOutputWindow : public vtkOutputWindow {
 public:
  static SilentOutputWindow* New() { VTK_STANDARD_NEW_BODY(SilentOutputWindow); }
  void DisplayText(const char*) override {}
};

// The one context of this process, for all windows that it makes one after the other.
class EglContext {
 public:
  EglContext() {
    if (!open_display() || !create()) return;
    works_ = make_current();
  }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;
  // The display stays open: closing it unloads the driver, and a leak checker could then no longer
  // say whose the driver's leaks are.
  ~EglContext() {
    if (context_ == EGL_NO_CONTEXT) return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
  }

  bool works() const { return works_; }
  bool make_current() const {
    return eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
  }
  bool is_current() const { return eglGetCurrentContext() == context_; }

 private:
  bool open_display() {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (extensions == nullptr ||
        std::string(extensions).find("EGL_MESA_platform_surfaceless") == std::string::npos)
      return false;
    display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    return display_ != EGL_NO_DISPLAY && eglInitialize(display_, nullptr, nullptr) == EGL_TRUE &&
           eglBindAPI(EGL_OPENGL_API) == EGL_TRUE;
  }

  bool create() {
    const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    if (eglChooseConfig(display_, wanted, &config, 1, &found) != EGL_TRUE || found < 1)
      return false;
    const EGLint core_3_2[] = {EGL_CONTEXT_MAJOR_VERSION,
                               3,
                               EGL_CONTEXT_MINOR_VERSION,
                               2,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, core_3_2);
    return context_ != EGL_NO_CONTEXT;
  }

  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
  bool works_ = false;
};

const EglContext& egl_context() {
  static const EglContext context;
  return context;
}

void make_current(vtkObject*, unsigned long, void*, void*) { egl_context().make_current(); }

void tell_whether_current(vtkObject*, unsigned long, void*, void* answer) {
  *static_cast<bool*>(answer) = egl_context().is_current();
}

void observe(vtkRenderWindow& window, unsigned long event,
             void (*callback)(vtkObject*, unsigned long, void*, void*)) {
  vtkNew<vtkCallbackCommand> command;
  command->SetCallback(callback);
  window.AddObserver(event, command);
}

void set_up(vtkRenderWindow& window, int width_px, int height_px) {
  window.SetSize(width_px * kSupersampling, height_px * kSupersampling);
  window.SetMultiSamples(0);
  window.SetDPI(72);  // so that font sizes are pixels
}

vtkSmartPointer<vtkRenderWindow> window_without_display(int width_px, int height_px) {
  if (!egl_context().works()) return nullptr;
  auto window = vtkSmartPointer<vtkGenericOpenGLRenderWindow>::New();
  observe(*window, vtkCommand::WindowMakeCurrentEvent, make_current);
  observe(*window, vtkCommand::WindowIsCurrentEvent, tell_whether_current);
  set_up(*window, width_px, height_px);
  window->SetFrameBlitModeToNoBlit();
  window->SetReadyForRendering(true);
  window->OpenGLInit();
  return window;
}

// VTK ends the process when the server does not answer, so this asks first.
bool display_answers() {
  if (std::getenv("DISPLAY") == nullptr) return false;
  Display* display = XOpenDisplay(nullptr);
  if (display == nullptr) return false;
  XCloseDisplay(display);
  return true;
}

vtkSmartPointer<vtkRenderWindow> window_of_display(int width_px, int height_px) {
  if (!display_answers()) return nullptr;
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetOffScreenRendering(1);
  set_up(*window, width_px, height_px);
  return window;
}

unsigned char mean_of_block(const unsigned char* corner, vtkIdType row_stride) {
  int sum = 0;
  for (int row = 0; row < kSupersampling; ++row) {
    for (int column = 0; column < kSupersampling; ++column)
      sum += corner[row * row_stride + column * 3];
  }
  constexpr int kSamples = kSupersampling * kSupersampling;
  return static_cast<unsigned char>((sum + kSamples / 2) / kSamples);
}

vtkSmartPointer<vtkImageData> averaged_down(vtkImageData& large) {
  const int* size = large.GetDimensions();
  const int width = size[0] / kSupersampling;
  const int height = size[1] / kSupersampling;
  auto small = vtkSmartPointer<vtkImageData>::New();
  small->SetDimensions(width, height, 1);
  small->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const auto* from = static_cast<const unsigned char*>(large.GetScalarPointer());
  auto* to = static_cast<unsigned char*>(small->GetScalarPointer());
  const vtkIdType row_stride = vtkIdType{size[0]} * 3;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const unsigned char* corner = from + y * kSupersampling * row_stride + x * kSupersampling * 3;
      for (int channel = 0; channel < 3; ++channel)
        *to++ = mean_of_block(corner + channel, row_stride);
    }
  }
  return small;
}

}  // namespace

void silence_graphics_libraries() {
  vtkObject::GlobalWarningDisplayOff();
  vtkNew<SilentOutputWindow> silent;
  vtkOutputWindow::SetInstance(silent);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  setenv("EGL_LOG_LEVEL", "fatal", 0);
  setenv("MESA_DEBUG", "silent", 0);
  // A picture is a second's work for a processor and the same on every machine; graphics cards
  // differ, and their drivers fail in more ways.
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 0);
}

vtkSmartPointer<vtkRenderWindow> offscreen_window(int width_px, int height_px) {
  if (auto window = window_without_display(width_px, height_px)) return window;
  if (auto window = window_of_display(width_px, height_px)) return window;
  throw NoGraphics(
      "no picture can be drawn here: Mesa's EGL offers no OpenGL 3.2 context without a display, "
      "and no display answers");
}

std::string png_bytes(vtkImageData& image) {
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(&image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  if (bytes == nullptr || bytes->GetNumberOfValues() == 0)
    throw NoGraphics("the picture could not be encoded");
  return {reinterpret_cast<const char*>(bytes->GetPointer(0)),
          static_cast<std::size_t>(bytes->GetNumberOfValues())};
}

vtkSmartPointer<vtkImageData> pixels_of(vtkRenderWindow& window) {
  window.Render();
  vtkNew<vtkWindowToImageFilter> capture;
  capture->SetInput(&window);
  capture->SetInputBufferTypeToRGB();
  capture->ReadFrontBufferOff();
  capture->ShouldRerenderOff();
  capture->Update();
  vtkImageData* large = capture->GetOutput();
  if (large == nullptr || large->GetNumberOfPoints() == 0 ||
      large->GetNumberOfScalarComponents() != 3) {
    throw NoGraphics("the graphics library drew nothing");
  }
  return averaged_down(*large);
}

std::string png_of(vtkRenderWindow& window) { return png_bytes(*pixels_of(window)); }

}  // namespace palpation::draw
