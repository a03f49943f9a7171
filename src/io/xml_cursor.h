/// The tags of an XML file in turn, and the text between them: as much of XML as VTK's files need.
///
/// Whatever could hide or multiply text (document types, CDATA, entities but the five of XML
/// itself) is refused, and so is nesting deeper than a file of VTK has: time and memory stay within
/// the bytes of the file.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/mesh_source.h"

namespace palpation {

/// A start tag: <Name attribute="value" ...>. Views stay valid as long as the file's bytes.
struct XmlTag {
  std::string_view name;
  std::vector<std::pair<std::string_view, std::string_view>>
      attributes;         ///< values with their entities replaced are `attribute`'s
  std::size_t place = 0;  ///< byte of its '<'

  std::optional<std::string> attribute(std::string_view name) const;
};

class XmlCursor {
 public:
  explicit XmlCursor(const MeshSource& source) : source_(source) {}

  /// Enters the next child of the element that was entered last and returns its tag. At the end of
  /// that element, leaves it and returns nothing. Throws IoError naming the byte where the file is
  /// no XML or ends too early.
  std::optional<XmlTag> enter_child();
  /// Leaves the element that was entered last, with all that is still in it.
  void skip_content();
  /// What stood in front of the last tag, without blanks around it.
  std::string_view text_before() const { return text_; }
  /// Where the next text begins.
  std::size_t position() const { return position_; }
  /// Goes on behind bytes that are no XML.
  void jump_to(std::size_t position) { position_ = position; }
  /// Throws IoError if anything but blanks and comments follows the first element.
  void expect_end();

 private:
  std::optional<XmlTag> start_tag();
  void take_text();
  void skip_to_tag();
  void end_tag();
  std::string_view name_at_position();
  void take_attribute(XmlTag& tag);
  [[noreturn]] void fail_at_end() const;

  const MeshSource& source_;
  std::size_t position_ = 0;
  std::string_view text_;
  std::vector<std::string_view> open_;
  bool last_was_empty_ = false;  ///< the element entered last was <Name/>
};

std::string_view without_blanks_around(std::string_view text);

}  // namespace palpation
