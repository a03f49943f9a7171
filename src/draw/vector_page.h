/// A page as shapes, words and images, for papers: SVG and PDF.
#pragma once

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

#include "draw/paper.h"

namespace palpation::draw {

/// A filled polygon, or words where there are any.
struct Mark {
  std::vector<Pixel> corners;
  Colour colour;
  std::string words;
  Pixel place = Pixel::Zero();
  TextStyle style;
};

struct PageImage {
  Box box;
  vtkSmartPointer<vtkImageData> pixels;  ///< red, green, blue; the first row is the lowest
};

struct VectorPage {
  int width_px = 0;
  int height_px = 0;
  std::vector<PageImage> images;  ///< below all marks
  std::vector<Mark> marks;        ///< each above those before
};

/// The text of an SVG file that is so wide. Throws NoGraphics where an image cannot be encoded.
std::string svg_of(const VectorPage& page, double width_mm);

/// The bytes of a PDF file of one page that is so wide, in Helvetica, which every reader has. What
/// its Latin alphabet lacks becomes a question mark.
std::string pdf_of(const VectorPage& page, double width_mm);

}  // namespace palpation::draw
