// A page as SVG: millimetres outside, the sheet's pixels within.
#include <array>
#include <cstdio>

#include "draw/offscreen.h"
#include "draw/vector_page.h"
#include "palpation/base/error.h"
#include "results/page.h"
#include "results/sha256.h"

namespace palpation::draw {
namespace {

std::string number(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);
  return text.data();
}

std::string hex(Colour colour) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", colour.red, colour.green, colour.blue);
  return text.data();
}

std::string polygon(const Mark& mark, double height) {
  std::string points;
  for (const Pixel& corner : mark.corners)
    points += (points.empty() ? "M" : "L") + number(corner.x()) + " " + number(height - corner.y());
  return "<path d=\"" + points + "Z\" fill=\"" + hex(mark.colour) + "\"/>\n";
}

/// Capitals are about 0.72 of the size high.
double below_middle(const TextStyle& style) {
  switch (style.vertical) {
    case Vertical::Bottom:
      return 0.0;
    case Vertical::Centre:
      return 0.36 * style.size_px;
    case Vertical::Top:
      return 0.72 * style.size_px;
  }
  return 0.0;
}

std::string words(const Mark& mark, double height) {
  const std::string x = number(mark.place.x()), y = number(height - mark.place.y());
  const char* anchor = mark.style.horizontal == Horizontal::Left     ? "start"
                       : mark.style.horizontal == Horizontal::Centre ? "middle"
                                                                     : "end";
  return "<text x=\"" + x + "\" y=\"" + y + "\" dy=\"" + number(below_middle(mark.style)) +
         "\" font-size=\"" + number(mark.style.size_px) + "\"" +
         (mark.style.bold ? " font-weight=\"bold\"" : "") + " text-anchor=\"" + anchor +
         "\" fill=\"" + hex(mark.style.colour) + "\"" +
         (mark.style.turned_deg != 0.0
              ? " transform=\"rotate(" + number(-mark.style.turned_deg) + " " + x + " " + y + ")\""
              : "") +
         ">" + results::escaped(mark.words) + "</text>\n";
}

}  // namespace

std::string svg_of(const VectorPage& page, double width_mm) {
  const double height = page.height_px;
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(width_mm) +
                    "mm\" height=\"" + number(width_mm * height / page.width_px) +
                    "mm\" viewBox=\"0 0 " + std::to_string(page.width_px) + " " +
                    std::to_string(page.height_px) +
                    "\" font-family=\"Arial, Helvetica, 'Liberation Sans', sans-serif\">\n"
                    "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  for (const PageImage& image : page.images)
    svg += "<image x=\"" + number(image.box.left) + "\" y=\"" + number(height - image.box.top()) +
           "\" width=\"" + number(image.box.width) + "\" height=\"" + number(image.box.height) +
           "\" preserveAspectRatio=\"none\" href=\"data:image/png;base64," +
           results::base64(png_bytes(*image.pixels)) + "\"/>\n";
  for (const Mark& mark : page.marks)
    svg += mark.words.empty() ? polygon(mark, height) : words(mark, height);
  return svg + "</svg>\n";
}

}  // namespace palpation::draw
