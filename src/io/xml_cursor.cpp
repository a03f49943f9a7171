#include "io/xml_cursor.h"

#include <algorithm>
#include <array>

#include "io/number_text.h"

namespace palpation {
namespace {

constexpr std::size_t kDeepest = 32;
constexpr std::size_t kMostAttributes = 64;
constexpr std::string_view kBlank = " \t\r\n";

bool is_blank(char c) { return kBlank.find(c) != std::string_view::npos; }

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == '.' || c == ':';
}

struct Entity {
  std::string_view name;
  char character;
};
constexpr std::array<Entity, 5> kEntities = {
    {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}}};

const Entity* entity_at(std::string_view text) {
  const auto found = std::find_if(kEntities.begin(), kEntities.end(), [&](const Entity& entity) {
    return text.starts_with(entity.name);
  });
  return found == kEntities.end() ? nullptr : &*found;
}

}  // namespace

std::string_view without_blanks_around(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  return first == std::string_view::npos
             ? std::string_view()
             : text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::optional<std::string> XmlTag::attribute(std::string_view wanted) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const auto& attribute) { return attribute.first == wanted; });
  if (found == attributes.end()) return std::nullopt;
  std::string value;
  for (std::string_view rest = found->second; !rest.empty();) {
    const Entity* entity = entity_at(rest);
    value += entity != nullptr ? entity->character : rest.front();
    rest.remove_prefix(entity != nullptr ? entity->name.size() : 1);
  }
  return value;
}

std::optional<XmlTag> XmlCursor::enter_child() {
  if (last_was_empty_) {
    last_was_empty_ = false;
    text_ = {};
    open_.pop_back();
    return std::nullopt;
  }
  take_text();
  if (source_.bytes.substr(position_).starts_with("</")) {
    end_tag();
    return std::nullopt;
  }
  return start_tag();
}

void XmlCursor::skip_content() {
  for (std::size_t depth = open_.size(); open_.size() >= depth && depth > 0;) enter_child();
}

void XmlCursor::expect_end() {
  while (true) {
    position_ = std::min(source_.bytes.find_first_not_of(kBlank, position_), source_.bytes.size());
    if (position_ == source_.bytes.size()) return;
    if (!source_.bytes.substr(position_).starts_with("<!--"))
      source_.fail_at_byte(position_, "something follows the end of the last element");
    skip_to_tag();
  }
}

/// Up to the next tag, over comments and processing instructions, of which text may be on one side
/// only.
void XmlCursor::take_text() {
  text_ = {};
  while (true) {
    const std::size_t start = position_;
    position_ = source_.bytes.find('<', start);
    if (position_ == std::string_view::npos) fail_at_end();
    const std::string_view text =
        without_blanks_around(source_.bytes.substr(start, position_ - start));
    if (!text.empty() && !text_.empty())
      source_.fail_at_byte(position_, "a comment divides a text");
    if (!text.empty()) text_ = text;
    const std::string_view rest = source_.bytes.substr(position_);
    if (!rest.starts_with("<!") && !rest.starts_with("<?")) return;
    skip_to_tag();
  }
}

void XmlCursor::skip_to_tag() {
  const std::string_view rest = source_.bytes.substr(position_);
  if (!rest.starts_with("<!--") && !rest.starts_with("<?"))
    source_.fail_at_byte(position_, "document types, entities and CDATA are not read");
  const std::string_view end = rest.starts_with("<?") ? "?>" : "-->";
  const std::size_t close = rest.find(end, end.size() + 1);
  if (close == std::string_view::npos) fail_at_end();
  position_ += close + end.size();
}

void XmlCursor::end_tag() {
  const std::size_t place = position_;
  position_ += 2;
  const std::string_view name = name_at_position();
  position_ = std::min(source_.bytes.find_first_not_of(kBlank, position_), source_.bytes.size());
  if (position_ == source_.bytes.size()) fail_at_end();
  if (open_.empty() || name != open_.back() || source_.bytes[position_] != '>') {
    source_.fail_at_byte(
        place, "an end tag " + (open_.empty() ? "closes nothing"
                                              : "must be </" + std::string(open_.back()) + ">"));
  }
  ++position_;
  open_.pop_back();
}

std::optional<XmlTag> XmlCursor::start_tag() {
  XmlTag tag;
  tag.place = position_++;
  tag.name = name_at_position();
  if (tag.name.empty()) source_.fail_at_byte(tag.place, "a tag has no name");
  while (true) {
    const std::size_t next = source_.bytes.find_first_not_of(kBlank, position_);
    if (next == std::string_view::npos) fail_at_end();
    const bool separated = next > position_;
    position_ = next;
    const std::string_view rest = source_.bytes.substr(position_);
    last_was_empty_ = rest.starts_with("/>");
    if (last_was_empty_ || rest.front() == '>') break;
    if (!separated) source_.fail_at_byte(position_, "an attribute needs a blank before it");
    take_attribute(tag);
  }
  position_ += last_was_empty_ ? 2 : 1;
  if (open_.size() == kDeepest)
    source_.fail_at_byte(tag.place, "elements are nested deeper than " + std::to_string(kDeepest));
  open_.push_back(tag.name);
  return tag;
}

std::string_view XmlCursor::name_at_position() {
  const std::size_t first = position_;
  while (position_ < source_.bytes.size() && is_name_character(source_.bytes[position_]))
    ++position_;
  return source_.bytes.substr(first, position_ - first);
}

void XmlCursor::take_attribute(XmlTag& tag) {
  const std::size_t place = position_;
  const std::string_view name = name_at_position();
  const auto skip_blanks = [this] {
    while (position_ < source_.bytes.size() && is_blank(source_.bytes[position_])) ++position_;
  };
  skip_blanks();
  const bool has_value = position_ < source_.bytes.size() && source_.bytes[position_] == '=';
  position_ += has_value ? 1 : 0;
  skip_blanks();
  if (position_ == source_.bytes.size()) fail_at_end();
  const char quote = source_.bytes[position_];
  if (name.empty() || !has_value || (quote != '"' && quote != '\''))
    source_.fail_at_byte(place, "an attribute must be name=\"value\"");
  const std::size_t end = source_.bytes.find(quote, position_ + 1);
  if (end == std::string_view::npos) fail_at_end();
  const std::string_view value = source_.bytes.substr(position_ + 1, end - position_ - 1);
  for (std::size_t at = value.find('&'); at != std::string_view::npos;
       at = value.find('&', at + 1)) {
    if (entity_at(value.substr(at)) == nullptr)
      source_.fail_at_byte(position_ + 1 + at, "entities but those of XML itself are not read");
  }
  if (value.find('<') != std::string_view::npos)
    source_.fail_at_byte(position_, "a value with \"<\" in it");
  for (const auto& other : tag.attributes) {
    if (other.first == name)
      source_.fail_at_byte(place, "attribute " + in_quotes(name) + " appears twice");
  }
  if (tag.attributes.size() == kMostAttributes)
    source_.fail_at_byte(place, "more than " + std::to_string(kMostAttributes) + " attributes");
  tag.attributes.emplace_back(name, value);
  position_ = end + 1;
}

void XmlCursor::fail_at_end() const {
  source_.fail_at_byte(source_.bytes.size(),
                       open_.empty() ? "the file ends before its first element"
                                     : "the file ends inside <" + std::string(open_.back()) + ">");
}

}  // namespace palpation
