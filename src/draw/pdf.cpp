// A page as PDF 1.4: one content stream, two of the fonts that every reader has, images deflated.
#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>
#include <vtkZLibDataCompressor.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "draw/sheet.h"
#include "draw/vector_page.h"

namespace palpation::draw {
namespace {

constexpr double kPointsPerMm = 72.0 / 25.4;

std::string number(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.3f", value);
  return text.data();
}

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += number(value) + " ";
  return text;
}

std::string colour_of(Colour colour) {
  return numbers({colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0}) + "rg ";
}

/// In WinAnsiEncoding, whose upper half is Latin-1's but for dashes and the like.
std::string encoded(const std::string& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto byte = [&](std::size_t k) {
      return i + k < words.size() ? static_cast<unsigned char>(words[i + k]) : 0u;
    };
    if (byte(0) < 0x80) {
      if (words[i] == '(' || words[i] == ')' || words[i] == '\\') text += '\\';
      text += words[i];
    } else if (byte(0) == 0xC2 || byte(0) == 0xC3) {
      text += static_cast<char>(byte(0) == 0xC2 ? byte(1) : byte(1) + 0x40u);
      ++i;
    } else if (byte(0) == 0xE2 && byte(1) == 0x80 && (byte(2) == 0x93 || byte(2) == 0x94)) {
      text += static_cast<char>(byte(2) == 0x93 ? 0x96 : 0x97);
      i += 2;
    } else {
      text += '?';
      while ((byte(1) & 0xC0u) == 0x80u) ++i;
    }
  }
  return text;
}

std::string polygon(const Mark& mark) {
  std::string code = colour_of(mark.colour);
  for (std::size_t i = 0; i < mark.corners.size(); ++i)
    code += numbers({mark.corners[i].x(), mark.corners[i].y()}) + (i == 0 ? "m " : "l ");
  return code + "h f\n";
}

std::string words_of(const Mark& mark) {
  TextStyle straight = mark.style;
  straight.turned_deg = 0.0;
  const double width = text_width_px(mark.words, straight);
  const double back = mark.style.horizontal == Horizontal::Left     ? 0.0
                      : mark.style.horizontal == Horizontal::Centre ? 0.5 * width
                                                                    : width;
  const double down = mark.style.vertical == Vertical::Bottom   ? 0.0
                      : mark.style.vertical == Vertical::Centre ? 0.36 * mark.style.size_px
                                                                : 0.72 * mark.style.size_px;
  const double angle = mark.style.turned_deg * std::numbers::pi / 180.0;
  const double c = std::cos(angle), s = std::sin(angle);
  return "BT " + colour_of(mark.style.colour) + (mark.style.bold ? "/B " : "/R ") +
         number(mark.style.size_px) + " Tf " +
         numbers({c, s, -s, c, mark.place.x() - back * c + down * s,
                  mark.place.y() - back * s - down * c}) +
         "Tm (" + encoded(mark.words) + ") Tj ET\n";
}

std::string deflated(const std::string& bytes) {
  vtkNew<vtkZLibDataCompressor> compressor;
  std::string result(compressor->GetMaximumCompressionSpace(bytes.size()), '\0');
  const std::size_t size =
      compressor->Compress(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
                           reinterpret_cast<unsigned char*>(result.data()), result.size());
  result.resize(size);
  return result;
}

std::string stream(const std::string& dictionary, const std::string& bytes) {
  const std::string packed = deflated(bytes);
  return "<< " + dictionary + " /Filter /FlateDecode /Length " + std::to_string(packed.size()) +
         " >>\nstream\n" + packed + "\nendstream";
}

/// The first row of a PDF's image is the highest.
std::string image_object(vtkImageData& image) {
  const int* size = image.GetDimensions();
  std::string bytes;
  for (int row = size[1] - 1; row >= 0; --row) {
    const auto* first =
        static_cast<const char*>(image.GetScalarPointer()) + std::ptrdiff_t{3} * size[0] * row;
    bytes.append(first, static_cast<std::size_t>(3 * size[0]));
  }
  return stream(
      "/Type /XObject /Subtype /Image /ColorSpace /DeviceRGB /BitsPerComponent 8 /Width " +
          std::to_string(size[0]) + " /Height " + std::to_string(size[1]),
      bytes);
}

std::string font(const std::string& name) {
  return "<< /Type /Font /Subtype /Type1 /Encoding /WinAnsiEncoding /BaseFont /" + name + " >>";
}

std::string content_of(const VectorPage& page, double scale) {
  std::string content = "q " + numbers({scale, 0, 0, scale, 0, 0}) + "cm\n";
  for (std::size_t i = 0; i < page.images.size(); ++i) {
    const Box& box = page.images[i].box;
    content += "q " + numbers({box.width, 0, 0, box.height, box.left, box.bottom}) + "cm /I" +
               std::to_string(i) + " Do Q\n";
  }
  for (const Mark& mark : page.marks)
    content += mark.words.empty() ? polygon(mark) : words_of(mark);
  return content + "Q\n";
}

}  // namespace

std::string pdf_of(const VectorPage& page, double width_mm) {
  const double scale = width_mm * kPointsPerMm / page.width_px;
  std::string images;
  for (std::size_t i = 0; i < page.images.size(); ++i)
    images += "/I" + std::to_string(i) + " " + std::to_string(i + 7) + " 0 R ";
  std::vector<std::string> objects = {
      "<< /Type /Catalog /Pages 2 0 R >>",
      "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
      "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 " +
          numbers({page.width_px * scale, page.height_px * scale}) +
          "] /Contents 4 0 R /Resources << /Font << /R 5 0 R /B 6 0 R >> /XObject << " + images +
          ">> >> >>",
      stream("", content_of(page, scale)),
      font("Helvetica"),
      font("Helvetica-Bold")};
  for (const PageImage& image : page.images) objects.push_back(image_object(*image.pixels));
  std::string pdf = "%PDF-1.4\n%\xE2\xE3\xCF\xD3\n";
  std::string table;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    std::array<char, 32> entry{};
    std::snprintf(entry.data(), entry.size(), "%010zu 00000 n \n", pdf.size());
    table += entry.data();
    pdf += std::to_string(i + 1) + " 0 obj\n" + objects[i] + "\nendobj\n";
  }
  const std::string count = std::to_string(objects.size() + 1);
  return pdf + "xref\n0 " + count + "\n0000000000 65535 f \n" + table + "trailer\n<< /Size " +
         count + " /Root 1 0 R >>\nstartxref\n" + std::to_string(pdf.size()) + "\n%%EOF\n";
}

}  // namespace palpation::draw
