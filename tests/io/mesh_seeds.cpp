#include "io/mesh_seeds.h"

#include <charconv>
#include <cmath>
#include <cstdint>

namespace palpation::catalogue {
namespace {

std::string text_of(double value) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

std::string text_of(const std::array<double, 3>& point) {
  return text_of(point[0]) + " " + text_of(point[1]) + " " + text_of(point[2]);
}

std::string text_of(const std::array<int, 3>& face, int first) {
  return std::to_string(face[0] + first) + " " + std::to_string(face[1] + first) + " " +
         std::to_string(face[2] + first);
}

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u;
    };
    const std::uint32_t bits = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (int k = 0; k < 4; ++k) text += kDigits[bits >> (18 - 6 * k) & 63];
    for (std::size_t k = bytes.size() - i; k < 3; ++k) text[text.size() - 3 + k] = '=';
  }
  return text;
}

/// zlib's format around bytes that are stored as they are.
std::string stored_zlib(const std::string& bytes) {
  std::uint32_t a = 1, b = 0;
  for (const char c : bytes) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto size = static_cast<std::uint16_t>(bytes.size());
  return std::string("\x78\x01\x01", 3) + bytes_of(size) +
         bytes_of(static_cast<std::uint16_t>(~size)) + bytes + bytes_of(b << 16 | a, true);
}

/// One file in the making: its arrays, in whichever way they are to be written.
class VtpWriter {
 public:
  explicit VtpWriter(const VtpStyle& style) : style_(style) {}

  std::string array(const std::string& attributes, const std::vector<double>& numbers, bool whole) {
    const std::string type = whole           ? (style_.narrow ? "Int32" : "Int64")
                             : style_.narrow ? "Float32"
                                             : "Float64";
    std::string start = "<DataArray type=\"" + type + "\" " + attributes;
    if (style_.arrays == VtpStyle::Arrays::Ascii) {
      start += " format=\"ascii\">";
      for (const double number : numbers) start += text_of(number) + " ";
      return start + "</DataArray>\n";
    }
    const std::string written = written_bytes(bytes_in(numbers, whole));
    if (style_.arrays == VtpStyle::Arrays::Base64)
      return start + " format=\"binary\">" + written + "</DataArray>\n";
    start += " format=\"appended\" offset=\"" + std::to_string(appended_.size()) + "\"/>\n";
    appended_ += written;
    return start;
  }

  std::string head() const {
    return std::string(
               "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
               "byte_order=\"") +
           (style_.big_endian ? "BigEndian" : "LittleEndian") + "\" header_type=\"" +
           (style_.wide_header ? "UInt64" : "UInt32") + "\"" +
           (style_.compressed ? " compressor=\"vtkZLibDataCompressor\"" : "") + ">\n<PolyData>\n";
  }

  std::string tail() const {
    const bool is_appended = style_.arrays == VtpStyle::Arrays::AppendedRaw ||
                             style_.arrays == VtpStyle::Arrays::AppendedBase64;
    const std::string encoding = style_.arrays == VtpStyle::Arrays::AppendedRaw ? "raw" : "base64";
    return "</PolyData>\n" +
           (is_appended ? "<AppendedData encoding=\"" + encoding + "\">\n_" + appended_ +
                              "\n</AppendedData>\n"
                        : "") +
           "</VTKFile>\n";
  }

 private:
  std::string word(std::size_t size) const {
    return style_.wide_header ? bytes_of(std::uint64_t{size}, style_.big_endian)
                              : bytes_of(static_cast<std::uint32_t>(size), style_.big_endian);
  }

  std::string bytes_in(const std::vector<double>& numbers, bool whole) const {
    std::string bytes;
    for (const double number : numbers) {
      const bool big = style_.big_endian;
      if (whole) {
        bytes += style_.narrow ? bytes_of(static_cast<std::int32_t>(number), big)
                               : bytes_of(static_cast<std::int64_t>(number), big);
      } else {
        bytes += style_.narrow ? bytes_of(static_cast<float>(number), big) : bytes_of(number, big);
      }
    }
    return bytes;
  }

  std::string written_bytes(const std::string& bytes) const {
    const bool raw = style_.arrays == VtpStyle::Arrays::AppendedRaw;
    if (!style_.compressed)
      return raw ? word(bytes.size()) + bytes : base64(word(bytes.size()) + bytes);
    constexpr std::size_t kBlock = 64;
    std::string header = word((bytes.size() + kBlock - 1) / kBlock) + word(kBlock) +
                         word(bytes.size() % kBlock),
                body;
    for (std::size_t start = 0; start < bytes.size(); start += kBlock) {
      const std::string block = stored_zlib(bytes.substr(start, kBlock));
      header += word(block.size());
      body += block;
    }
    return raw ? header + body : base64(header) + base64(body);
  }

  VtpStyle style_;
  std::string appended_;
};

}  // namespace

Shape square() { return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}; }

Shape tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

Shape grid() {
  Shape shape;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      shape.points.push_back({column / 3.0, -row / 7.0, 1e-3 * std::sqrt(1.0 + row + column)});
  }
  for (const int corner : {0, 1, 3, 4}) {
    shape.faces.push_back({corner, corner + 3, corner + 4});
    shape.faces.push_back({corner, corner + 4, corner + 1});
  }
  return shape;
}

std::string obj_of(const Shape& shape) {
  std::string text;
  for (const auto& point : shape.points) text += "v " + text_of(point) + "\n";
  for (const auto& face : shape.faces) text += "f " + text_of(face, 1) + "\n";
  return text;
}

std::string off_of(const Shape& shape) {
  std::string text = "OFF\n" + std::to_string(shape.points.size()) + " " +
                     std::to_string(shape.faces.size()) + " 0\n";
  for (const auto& point : shape.points) text += text_of(point) + "\n";
  for (const auto& face : shape.faces) text += "3 " + text_of(face, 0) + "\n";
  return text;
}

std::string ascii_stl_of(const Shape& shape) {
  std::string text = "solid s\n";
  for (const auto& face : shape.faces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face)
      text += "vertex " + text_of(shape.points[static_cast<std::size_t>(corner)]) + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid s\n";
}

std::string binary_stl_of(const Shape& shape, const std::string& title) {
  std::string bytes = title + std::string(80 - title.size(), ' ') +
                      bytes_of(static_cast<std::uint32_t>(shape.faces.size()));
  for (const auto& face : shape.faces) {
    bytes += std::string(12, '\0');
    for (const int corner : face) {
      for (const double coordinate : shape.points[static_cast<std::size_t>(corner)])
        bytes += bytes_of(static_cast<float>(coordinate));
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

std::string ply_of(const Shape& shape, PlyEncoding encoding) {
  const bool big = encoding == PlyEncoding::Big;
  const std::string name = encoding == PlyEncoding::Ascii ? "ascii"
                           : big                          ? "binary_big_endian"
                                                          : "binary_little_endian";
  std::string bytes =
      "ply\nformat " + name + " 1.0\nelement vertex " + std::to_string(shape.points.size()) +
      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
      std::to_string(shape.faces.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& point : shape.points) {
    if (encoding == PlyEncoding::Ascii) bytes += text_of(point) + "\n";
    for (const double coordinate : point)
      bytes += encoding == PlyEncoding::Ascii ? "" : bytes_of(coordinate, big);
  }
  for (const auto& face : shape.faces) {
    bytes += encoding == PlyEncoding::Ascii ? "3 " + text_of(face, 0) + "\n" : "\3";
    for (const int corner : face)
      bytes += encoding == PlyEncoding::Ascii ? "" : bytes_of(std::int32_t{corner}, big);
  }
  return bytes;
}

std::string vtp_of(const Shape& shape, const VtpStyle& style) {
  VtpWriter writer(style);
  std::vector<double> coordinates, corners, ends;
  for (const auto& point : shape.points)
    coordinates.insert(coordinates.end(), point.begin(), point.end());
  for (const auto& face : shape.faces) {
    corners.insert(corners.end(), face.begin(), face.end());
    ends.push_back(static_cast<double>(corners.size()));
  }
  const std::string points = writer.array("NumberOfComponents=\"3\"", coordinates, /*whole=*/false);
  const std::string connectivity = writer.array("Name=\"connectivity\"", corners, /*whole=*/true);
  const std::string offsets = writer.array("Name=\"offsets\"", ends, /*whole=*/true);
  return writer.head() + "<Piece NumberOfPoints=\"" + std::to_string(shape.points.size()) +
         "\" NumberOfPolys=\"" + std::to_string(shape.faces.size()) + "\">\n<Points>\n" + points +
         "</Points>\n<Polys>\n" + connectivity + offsets + "</Polys>\n</Piece>\n" + writer.tail();
}

std::vector<MeshSeed> mesh_seeds() {
  using Arrays = VtpStyle::Arrays;
  std::vector<MeshSeed> seeds;
  for (const auto& [name, shape] :
       {std::pair("square", square()), std::pair("tetrahedron", tetrahedron()),
        std::pair("grid", grid())}) {
    const auto add = [&, shape = shape, name = std::string(name)](
                         const std::string& way, const std::string& extension, std::string bytes) {
      seeds.push_back({name + ", " + way, name + extension, std::move(bytes),
                       static_cast<int>(shape.points.size()),
                       static_cast<int>(shape.faces.size())});
    };
    add("OBJ", ".obj", obj_of(shape));
    add("OFF", ".off", off_of(shape));
    add("ASCII STL", ".stl", ascii_stl_of(shape));
    add("binary STL", ".stl", binary_stl_of(shape));
    add("binary STL called solid", ".stl", binary_stl_of(shape, "solid s"));
    add("ASCII PLY", ".ply", ply_of(shape, PlyEncoding::Ascii));
    add("little-endian PLY", ".ply", ply_of(shape, PlyEncoding::Little));
    add("big-endian PLY", ".ply", ply_of(shape, PlyEncoding::Big));
    add("VTP as text", ".vtp", vtp_of(shape));
    add("VTP in base64", ".vtp", vtp_of(shape, {.arrays = Arrays::Base64, .wide_header = false}));
    add("VTP in compressed base64", ".vtp",
        vtp_of(shape, {.arrays = Arrays::Base64, .compressed = true, .narrow = true}));
    add("VTP appended", ".vtp",
        vtp_of(shape, {.arrays = Arrays::AppendedRaw, .big_endian = true, .narrow = true}));
    add("VTP appended and compressed", ".vtp",
        vtp_of(shape, {.arrays = Arrays::AppendedRaw, .compressed = true, .wide_header = false}));
    add("VTP appended in base64", ".vtp", vtp_of(shape, {.arrays = Arrays::AppendedBase64}));
    add("VTP appended in compressed base64", ".vtp",
        vtp_of(shape, {.arrays = Arrays::AppendedBase64, .compressed = true, .big_endian = true}));
  }
  return seeds;
}

}  // namespace palpation::catalogue
