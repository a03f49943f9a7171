#include "io/vtp_structure.h"

#include <algorithm>
#include <array>
#include <limits>

#include "io/number_text.h"
#include "io/xml_cursor.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

// Each takes more memory than bytes in the file. VTK writes one for each process that worked on it.
constexpr std::size_t kMostPieces = 10'000;
constexpr std::size_t kMostFieldTexts = 1'000;

/// Walks through the elements of a file and notes what its arrays say.
class StructureReader {
 public:
  StructureReader(const MeshSource& source, VtpLayout& layout, std::vector<VtpArray>& field_texts)
      : source_(source), layout_(layout), field_texts_(field_texts), xml_(source) {}

  std::vector<VtpPiece> read() {
    const std::optional<XmlTag> root = xml_.enter_child();
    if (!root || root->name != "VTKFile")
      source_.fail_at_byte(root ? root->place : 0,
                           "<VTKFile> is expected: this XML is no file of VTK");
    take_root(*root);
    while (const std::optional<XmlTag> child = xml_.enter_child()) {
      if (child->name == "PolyData") {
        take_poly_data(*child);
      } else if (child->name == "AppendedData") {
        take_appended_data(*child);
      } else {
        xml_.skip_content();
      }
    }
    if (!has_poly_data_) source_.fail_at_byte(root->place, "the file has no element <PolyData>");
    xml_.expect_end();
    return std::move(pieces_);
  }

 private:
  void take_root(const XmlTag& tag) {
    const std::string type = tag.attribute("type").value_or("");
    if (type != "PolyData") {
      source_.fail_at_byte(tag.place,
                           "the file holds " + in_quotes(type) +
                               ", and only \"PolyData\" is read: save the surface of it as VTP");
    }
    const std::string version = tag.attribute("version").value_or("1.0");
    if (version.substr(0, version.find('.')).find_first_not_of("012") != std::string::npos)
      source_.fail_at_byte(tag.place,
                           "version " + in_quotes(version) + " of the format is not known");
    const std::string order = tag.attribute("byte_order").value_or("LittleEndian");
    if (order != "LittleEndian" && order != "BigEndian")
      source_.fail_at_byte(tag.place,
                           "byte_order " + in_quotes(order) + " must be LittleEndian or BigEndian");
    layout_.order = order == "BigEndian" ? ByteOrder::Big : ByteOrder::Little;
    const std::string word = tag.attribute("header_type").value_or("UInt32");
    if (word != "UInt32" && word != "UInt64")
      source_.fail_at_byte(tag.place,
                           "header_type " + in_quotes(word) + " must be UInt32 or UInt64");
    layout_.word = word == "UInt64" ? 8 : 4;
    const std::string compressor = tag.attribute("compressor").value_or("");
    if (compressor == "vtkZLibDataCompressor") {
      layout_.compressor = VtpCompressor::ZLib;
    } else if (compressor == "vtkLZ4DataCompressor") {
      layout_.compressor = VtpCompressor::Lz4;
    } else if (compressor == "vtkLZMADataCompressor") {
      layout_.compressor = VtpCompressor::Lzma;
    } else if (!compressor.empty()) {
      source_.fail_at_byte(tag.place, "compressor " + in_quotes(compressor) + " is not known");
    }
  }

  /// From "_" to the last end tag: bytes that are no XML may look like tags.
  void take_appended_data(const XmlTag& tag) {
    if (layout_.appended) source_.fail_at_byte(tag.place, "a second element <AppendedData>");
    const std::string encoding = tag.attribute("encoding").value_or("");
    if (encoding != "raw" && encoding != "base64")
      source_.fail_at_byte(
          tag.place, "encoding " + in_quotes(encoding) + " of appended data must be raw or base64");
    layout_.appended_is_base64 = encoding == "base64";
    const std::size_t end = source_.bytes.rfind("</AppendedData");
    if (end == std::string_view::npos || end < xml_.position())
      source_.fail_at_byte(source_.bytes.size(), "the file ends inside <AppendedData>");
    const std::size_t mark = source_.bytes.find_first_not_of(" \t\r\n", xml_.position());
    if (source_.bytes[mark] != '_')
      source_.fail_at_byte(mark, "appended data must begin with \"_\"");
    layout_.appended = source_.bytes.substr(mark + 1, end - std::min(end, mark + 1));
    xml_.jump_to(end);
    if (xml_.enter_child()) source_.fail_at_byte(end, "appended data must end here");
  }

  void take_poly_data(const XmlTag& tag) {
    if (has_poly_data_) source_.fail_at_byte(tag.place, "a second element <PolyData>");
    has_poly_data_ = true;
    while (const std::optional<XmlTag> child = xml_.enter_child()) {
      if (child->name == "Piece") {
        take_piece(*child);
      } else if (child->name == "FieldData") {
        take_field_data();
      } else {
        xml_.skip_content();
      }
    }
  }

  /// Other programs keep anything here; texts alone may say what coordinates are.
  void take_field_data() {
    while (const std::optional<XmlTag> child = xml_.enter_child()) {
      const bool is_text = child->attribute("type").value_or("") == "String" &&
                           child->attribute("NumberOfTuples").value_or("1") == "1" &&
                           field_texts_.size() < kMostFieldTexts;
      if (!is_text) {
        xml_.skip_content();
        continue;
      }
      VtpArray array = vtp_array(source_, *child);
      array.text = text_of_array();
      field_texts_.push_back(std::move(array));
    }
  }

  void take_piece(const XmlTag& tag) {
    if (pieces_.size() == kMostPieces)
      source_.fail_at_byte(tag.place, "more than " + std::to_string(kMostPieces) + " pieces");
    VtpPiece& piece = pieces_.emplace_back();
    piece.place = tag.place;
    piece.points = count_of(tag, "NumberOfPoints");
    const std::array<std::pair<const char*, VtpCells*>, 4> kinds = {{{"Verts", &piece.verts},
                                                                     {"Lines", &piece.lines},
                                                                     {"Strips", &piece.strips},
                                                                     {"Polys", &piece.polys}}};
    for (const auto& [kind, cells] : kinds)
      *cells = {kind, count_of(tag, std::string("NumberOf") + kind), {}, {}, tag.place};
    while (const std::optional<XmlTag> child = xml_.enter_child()) {
      const auto found = std::find_if(kinds.begin(), kinds.end(),
                                      [&](const auto& kind) { return child->name == kind.first; });
      if (found != kinds.end()) {
        take_cells(*child, *found->second);
      } else if (child->name == "Points") {
        take_positions(*child, piece);
      } else if (child->name == "PointData") {
        each_array([&](VtpArray array) { piece.point_arrays.push_back(std::move(array)); });
      } else if (child->name == "CellData") {
        each_array([&](VtpArray array) { piece.cell_arrays.push_back(std::move(array)); });
      } else {
        xml_.skip_content();
      }
    }
  }

  std::int64_t count_of(const XmlTag& tag, const std::string& name) const {
    const std::string text = tag.attribute(name).value_or("0");
    const std::optional<std::int64_t> count = parse_integer(without_blanks_around(text));
    if (count && *count >= 0 && *count <= std::numeric_limits<int>::max()) return *count;
    source_.fail_at_byte(
        tag.place, name + " = " + in_quotes(text) + " must be a whole number from 0 to 2147483647");
  }

  void take_positions(const XmlTag& tag, VtpPiece& piece) {
    if (piece.positions) source_.fail_at_byte(tag.place, "a second element <Points> of a piece");
    int arrays = 0;
    each_array([&](VtpArray array) {
      ++arrays;
      piece.positions = std::move(array);
    });
    if (arrays != 1 && (arrays > 1 || piece.points > 0))
      source_.fail_at_byte(tag.place, "<Points> must hold one array");
    if (piece.positions && piece.positions->components != 3) {
      source_.fail_at_byte(piece.positions->place, "points must have three components, not " +
                                                       std::to_string(piece.positions->components));
    }
  }

  void take_cells(const XmlTag& tag, VtpCells& cells) {
    if (cells.connectivity || cells.offsets)
      source_.fail_at_byte(tag.place, "a second element <" + cells.kind + "> of a piece");
    each_array([&](VtpArray array) {
      if (array.name == "connectivity" && !cells.connectivity) {
        cells.connectivity = std::move(array);
      } else if (array.name == "offsets" && !cells.offsets) {
        cells.offsets = std::move(array);
      } else {
        source_.fail_at_byte(
            array.place, "<" + cells.kind +
                             "> must hold one array \"connectivity\" and one \"offsets\", not " +
                             in_quotes(array.name));
      }
    });
  }

  /// Calls for each array in the element that was entered last.
  template <typename Take>
  void each_array(Take take) {
    while (const std::optional<XmlTag> child = xml_.enter_child()) {
      if (child->name != "DataArray" && child->name != "Array") {
        xml_.skip_content();
        continue;
      }
      VtpArray array = vtp_array(source_, *child);
      array.text = text_of_array();
      take(std::move(array));
    }
  }

  /// The numbers may stand before, between or behind what else an array may hold (keys with
  /// information on it), in one stretch.
  std::string_view text_of_array() {
    std::string_view text;
    while (true) {
      const std::optional<XmlTag> child = xml_.enter_child();
      const std::string_view here = xml_.text_before();
      if (!here.empty() && !text.empty())
        source_.fail_at_byte(xml_.position(), "an array's numbers must stand in one place");
      if (!here.empty()) text = here;
      if (!child) return text;
      xml_.skip_content();
    }
  }

  const MeshSource& source_;
  VtpLayout& layout_;
  std::vector<VtpArray>& field_texts_;
  XmlCursor xml_;
  std::vector<VtpPiece> pieces_;
  bool has_poly_data_ = false;
};

}  // namespace

std::vector<VtpPiece> read_vtp_structure(const MeshSource& source, VtpLayout& layout,
                                         std::vector<VtpArray>& field_texts) {
  return StructureReader(source, layout, field_texts).read();
}

}  // namespace palpation
