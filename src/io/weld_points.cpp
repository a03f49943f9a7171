#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "io/bucket_sort.h"
#include "io/polygon_soup.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

/// A number that equal points share and others hardly ever: their coordinates' bits, stirred. What
/// a file does to make them meet only makes a bucket to be sorted.
std::size_t stirred(const Vec3& point) {
  std::uint64_t bits = 0;
  for (const double coordinate : point) {
    // Adding 0 turns -0 into 0.
    bits = (bits ^ std::bit_cast<std::uint64_t>(coordinate + 0.0)) * 0x9E3779B97F4A7C15u;
    bits ^= bits >> 32;
  }
  return bits;
}

bool is_before(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// Numbers of the points, equal ones one after the other and the lowest first.
std::vector<int> by_place(const std::vector<Vec3>& points) {
  std::vector<int> numbers(points.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  const auto point = [&](int number) -> const Vec3& {
    return points[static_cast<std::size_t>(number)];
  };
  const std::size_t buckets = std::bit_ceil(points.size() / 4 + 1);
  return sorted_in_buckets(
      numbers, buckets, [&](int number) { return stirred(point(number)) & (buckets - 1); },
      [&](int a, int b) {
        if (point(a) == point(b)) return a < b;
        return is_before(point(a), point(b));
      });
}

std::string text_of_point(const Vec3& p) {
  return "(" + text_of(p.x()) + ", " + text_of(p.y()) + ", " + text_of(p.z()) + ")";
}

double extent_of(const PolygonSoup& soup) {
  Vec3 low = soup.points.front(), high = low;
  for (const Vec3& point : soup.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return (high - low).maxCoeff();
}

struct CloseUp {
  double key;
  std::size_t number;
};

/// Points along a direction that no grid is perpendicular to: close points are close along it, and
/// few others are.
std::vector<CloseUp> along_skew_direction(const PolygonSoup& soup) {
  const Vec3 direction =
      Vec3(0.5436890126920764, 0.2955977425220848, 0.7861513777574233).normalized();
  std::vector<CloseUp> keys(soup.points.size());
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = {soup.points[i].dot(direction), i};
  std::sort(keys.begin(), keys.end(), [](const CloseUp& a, const CloseUp& b) {
    return a.key != b.key ? a.key < b.key : a.number < b.number;
  });
  return keys;
}

}  // namespace

std::int64_t weld_equal_points(PolygonSoup& soup) {
  std::vector<int> first_of(soup.points.size());
  int first = -1;
  for (const int i : by_place(soup.points)) {
    if (first < 0 ||
        soup.points[static_cast<std::size_t>(first)] != soup.points[static_cast<std::size_t>(i)])
      first = i;
    first_of[static_cast<std::size_t>(i)] = first;
  }
  std::vector<int> number(soup.points.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (first_of[i] != static_cast<int>(i)) {
      number[i] = number[static_cast<std::size_t>(first_of[i])];
      continue;
    }
    soup.points[kept] = soup.points[i];
    if (!soup.height_sd.empty()) soup.height_sd[kept] = soup.height_sd[i];
    number[i] = static_cast<int>(kept++);
  }
  const auto dropped = static_cast<std::int64_t>(soup.points.size() - kept);
  const auto count = static_cast<std::int64_t>(number.size());
  soup.points.resize(kept);
  if (!soup.height_sd.empty()) soup.height_sd.resize(kept);
  for (int& corner : soup.corners) {
    if (corner >= 0 && corner < count) corner = number[static_cast<std::size_t>(corner)];
  }
  return dropped;
}

std::int64_t warn_of_close_points(PolygonSoup& soup) {
  constexpr double kClose = 1e-12;
  // A bound on the work for points that were laid out to be costly: this is a warning, not a
  // promise.
  constexpr std::size_t kMostNeighbours = 32;
  const double close = kClose * extent_of(soup);
  const std::vector<CloseUp> keys = along_skew_direction(soup);
  std::int64_t equal = 0, near = 0;
  std::pair<std::size_t, std::size_t> first_equal, first_near;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Vec3& point = soup.points[keys[i].number];
    bool has_equal = false, has_near = false;
    std::size_t equal_to = 0, near_to = 0;
    for (std::size_t j = i + 1;
         j < keys.size() && j - i <= kMostNeighbours && keys[j].key - keys[i].key <= 2.0 * close;
         ++j) {
      const Vec3& other = soup.points[keys[j].number];
      if (!has_equal && other == point) {
        has_equal = true;
        equal_to = keys[j].number;
      } else if (!has_near && other != point && (other - point).norm() <= close) {
        has_near = true;
        near_to = keys[j].number;
      }
    }
    if (has_equal && equal++ == 0) first_equal = {keys[i].number, equal_to};
    if (has_near && near++ == 0) first_near = {keys[i].number, near_to};
  }
  const auto say = [&](std::int64_t count, const std::string& what,
                       std::pair<std::size_t, std::size_t> pair, const std::string& advice) {
    if (count == 0) return;
    soup.warn(std::to_string(count) + (count == 1 ? " vertex has " : " vertices have ") + what +
                  ", such as vertices " + std::to_string(pair.first) + " and " +
                  std::to_string(pair.second) + " (counted from 0 among those in use) at " +
                  text_of_point(soup.points[pair.first]) +
                  " in the file's unit: they are not joined unless asked for.",
              advice);
  };
  say(equal, "the same coordinates as another", first_equal,
      "The mesh has seams, across which it does not hang together. Weld them: surface.weld in a "
      "scene, or \"merge by distance\" in an "
      "editor.");
  say(near, "a near-duplicate within 1e-12 of the extent", first_near,
      "Two vertices were meant to be one. Merge them by distance in a mesh editor.");
  return equal;
}

}  // namespace palpation
