/// A window that nobody sees: VTK draws into it, and its pixels become a PNG file.
///
/// Needs no display: Mesa's EGL gives a context without a surface. Where that is impossible and
/// DISPLAY names a server that answers, an off-screen window of that server serves.
#pragma once

#include <vtkSmartPointer.h>

#include <stdexcept>
#include <string>

class vtkImageData;
class vtkRenderWindow;

namespace palpation::draw {

/// Everything is drawn this many times larger in both directions and averaged down: smooth edges
/// and text at any angle, on any driver.
inline constexpr int kSupersampling = 2;

/// Thrown where neither way leads to a picture.
class NoGraphics : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// VTK, loguru and Mesa keep quiet from here on: errors are told by this program's own words and
/// exit codes.
void silence_graphics_libraries();

/// A window of the given size times kSupersampling, ready to render into. Throws NoGraphics.
vtkSmartPointer<vtkRenderWindow> offscreen_window(int width_px, int height_px);

/// Renders and returns the bytes of a PNG file of the size asked for. Throws NoGraphics if no
/// pixels come back.
std::string png_of(vtkRenderWindow& window);

/// The same as an image, red, green and blue, its first row the lowest.
vtkSmartPointer<vtkImageData> pixels_of(vtkRenderWindow& window);
/// The bytes of a PNG file. Throws NoGraphics.
std::string png_bytes(vtkImageData& image);

}  // namespace palpation::draw
