#include "boundary/reproducer.h"

#include "palpation/base/error.h"

namespace palpation {

namespace {

constexpr std::size_t kMostCharacters = 20'000;
constexpr std::size_t kMostCorners = kMostCharacters / 4;  // "0 0,"

std::size_t corners_of(const Ring& ring) { return ring.size(); }

std::size_t corners_of(const PolygonWithHoles& polygon) {
  std::size_t count = polygon.outer.size();
  for (const Ring& hole : polygon.holes) count += hole.size();
  return count;
}

std::string text_of_item(const Ring& ring) {
  std::string text = "(";
  for (const Vec2& corner : ring) text += text_of(corner.x()) + " " + text_of(corner.y()) + ", ";
  return text + text_of(ring.front().x()) + " " + text_of(ring.front().y()) + ")";
}

std::string text_of_item(const PolygonWithHoles& polygon) {
  std::string text = "(" + text_of_item(polygon.outer);
  for (const Ring& hole : polygon.holes) {
    if (!hole.empty()) text += ", " + text_of_item(hole);
  }
  return text + ")";
}

bool is_nothing(const Ring& ring) { return ring.empty(); }
bool is_nothing(const PolygonWithHoles& polygon) { return polygon.outer.empty(); }

template <typename Item>
std::string text_of_all(const std::string& kind, std::span<const Item> items) {
  std::string text;
  std::size_t left_out = 0;
  std::size_t corners_left_out = 0;
  for (const Item& item : items) {
    if (is_nothing(item)) continue;
    std::string next = corners_of(item) <= kMostCorners ? text_of_item(item) : std::string();
    if (next.empty() || text.size() + next.size() > kMostCharacters) {
      ++left_out;
      corners_left_out += corners_of(item);
    } else {
      text += (text.empty() ? "" : ", ") + next;
    }
  }
  text = text.empty() ? kind + " EMPTY" : kind + " (" + text + ")";
  if (left_out == 0) return text;
  return text + " and " + std::to_string(left_out) + " more of " +
         std::to_string(corners_left_out) + " corners";
}

}  // namespace

std::string well_known_text(std::span<const PolygonWithHoles> polygons) {
  return text_of_all("MULTIPOLYGON", polygons);
}

std::string well_known_text(std::span<const Ring> rings) {
  return text_of_all("MULTILINESTRING", rings);
}

}  // namespace palpation
