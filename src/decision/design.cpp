#include "palpation/decision/design.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "decision/chart_locator.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

/// So thin is no tissue: its share of its chart's bounding box is below one in ten thousand.
constexpr std::int64_t kMostTries = 10'000;

std::vector<int> checked(const Surface& surface, int count, std::span<const int> candidates) {
  require(count >= 0, "initial_design", "count " + std::to_string(count), "must not be negative");
  std::vector<int> vertices(candidates.begin(), candidates.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (const int vertex :
       {vertices.empty() ? 0 : vertices.front(), vertices.empty() ? 0 : vertices.back()}) {
    require(vertex >= 0 && vertex < surface.vertex_count(), "initial_design",
            "candidate " + std::to_string(vertex), "is no vertex");
  }
  return vertices;
}

/// Weighted sampling without replacement (Efraimidis and Spirakis 2006): the least waiting times
/// -ln(uniform) / area.
std::vector<int> random_vertices(const Surface& surface, int count,
                                 const std::vector<int>& candidates, Random& random) {
  std::vector<std::pair<double, int>> waiting_times;
  for (const int vertex : candidates) {
    waiting_times.emplace_back(-std::log1p(-random.uniform()) / surface.vertex_areas()[vertex],
                               vertex);
  }
  std::nth_element(waiting_times.begin(), waiting_times.begin() + count, waiting_times.end());
  std::vector<int> vertices;
  for (int i = 0; i < count; ++i) vertices.push_back(waiting_times[i].second);
  return vertices;
}

/// For each place the nearest candidate in the chart that no place before it has taken, the lowest
/// of equals.
std::vector<int> nearest_free(const Surface& surface, const std::vector<Vec2>& places,
                              std::vector<int> candidates) {
  const Points2& uv = surface.chart().uv;
  std::vector<int> taken;
  for (const Vec2& place : places) {
    const auto distance2 = [&](int vertex) {
      return (uv.row(vertex).transpose() - place).squaredNorm();
    };
    auto nearest = candidates.begin();
    double least = std::numeric_limits<double>::infinity();
    for (auto candidate = candidates.begin(); candidate != candidates.end(); ++candidate) {
      const double d2 = distance2(*candidate);
      if (d2 < least) {
        least = d2;
        nearest = candidate;
      }
    }
    taken.push_back(*nearest);
    candidates.erase(nearest);
  }
  return taken;
}

/// `count` of the places, spread evenly over their order.
std::vector<Vec2> thinned(const std::vector<Vec2>& places, int count) {
  std::vector<Vec2> kept;
  for (int i = 0; i < count; ++i)
    kept.push_back(
        places[static_cast<std::int64_t>(i) * static_cast<std::int64_t>(places.size()) / count]);
  return kept;
}

struct GridShape {
  std::int64_t columns, rows;
};

/// How far from square the cells are: ln of the ratio of their sides, 0 for squares.
double elongation(const GridShape& shape, const Vec2& extent) {
  return std::abs(std::log(extent.x() / extent.y() * static_cast<double>(shape.rows) /
                           static_cast<double>(shape.columns)));
}

/// Of the grids of exactly this many cells the one whose cells are closest to square; of equals,
/// the one that is closest to square itself.
GridShape squarest(std::int64_t cells, const Vec2& extent) {
  GridShape best{cells, 1};
  const auto imbalance = [](const GridShape& shape) {
    return std::abs(shape.columns - shape.rows);
  };
  for (std::int64_t side = 1; side * side <= cells; ++side) {
    if (cells % side != 0) continue;
    for (const GridShape shape : {GridShape{side, cells / side}, GridShape{cells / side, side}}) {
      const double gain = elongation(best, extent) - elongation(shape, extent);
      const bool is_equal = std::abs(gain) < 1e-9;
      if (is_equal ? imbalance(shape) < imbalance(best) : gain > 0.0) best = shape;
    }
  }
  return best;
}

/// The least grid of at least `cells` cells that are at most twice as long as wide; with none up to
/// twice as many, the squarest of `cells`.
GridShape grid_shape(std::int64_t cells, const Vec2& extent) {
  for (std::int64_t more = cells; more <= 2 * cells; ++more) {
    const GridShape shape = squarest(more, extent);
    if (elongation(shape, extent) <= std::log(2.0) + 1e-9) return shape;
  }
  return squarest(cells, extent);
}

std::vector<Vec2> grid_places(std::int64_t cells, const ChartLocator& tissue) {
  const Vec2 extent = tissue.upper() - tissue.lower();
  const GridShape shape = grid_shape(cells, extent);
  const Vec2 cell = extent.cwiseQuotient(
      Vec2(static_cast<double>(shape.columns), static_cast<double>(shape.rows)));
  std::vector<Vec2> places;
  for (std::int64_t row = 0; row < shape.rows; ++row) {
    for (std::int64_t column = 0; column < shape.columns; ++column) {
      const Vec2 centre(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
      const Vec2 place = tissue.lower() + cell.cwiseProduct(centre);
      if (tissue.at(place)) places.push_back(place);
    }
  }
  return places;
}

[[noreturn]] void fail_on_thin_tissue() {
  throw NumericalError(
      "initial_design: the tissue fills less than a ten-thousandth of its chart's bounding box");
}

/// Finer and finer grids until enough of the cells' centres lie on the tissue.
std::vector<Vec2> grid_design(int count, const ChartLocator& tissue) {
  for (std::int64_t cells = count; cells <= count * kMostTries; cells += cells / 4 + 1) {
    const std::vector<Vec2> places = grid_places(cells, tissue);
    if (places.size() >= static_cast<std::size_t>(count)) return thinned(places, count);
  }
  fail_on_thin_tissue();
}

/// Roberts' R2: steps of 1/g and 1/g^2, g the real root of g^3 = g + 1.
std::vector<Vec2> low_discrepancy_design(int count, const ChartLocator& tissue, Random& random) {
  constexpr double g = 1.32471795724474602596;
  const double shift_u = random.uniform(), shift_v = random.uniform();
  const auto fraction = [](double x) { return x - std::floor(x); };
  std::vector<Vec2> places;
  for (std::int64_t k = 0; places.size() < static_cast<std::size_t>(count); ++k) {
    if (k > count * kMostTries) fail_on_thin_tissue();
    const double step = static_cast<double>(k);
    const Vec2 unit(fraction(shift_u + step / g), fraction(shift_v + step / (g * g)));
    const Vec2 place = tissue.lower() + (tissue.upper() - tissue.lower()).cwiseProduct(unit);
    if (tissue.at(place)) places.push_back(place);
  }
  return places;
}

std::vector<int> designed(const Surface& surface, Design design, int count,
                          const std::vector<int>& candidates, Random& random) {
  if (design == Design::Random) return random_vertices(surface, count, candidates, random);
  const ChartLocator tissue(surface);
  const std::vector<Vec2> places = design == Design::Grid
                                       ? grid_design(count, tissue)
                                       : low_discrepancy_design(count, tissue, random);
  return nearest_free(surface, places, candidates);
}

}  // namespace

std::vector<int> initial_design(const Surface& surface, Design design, int count,
                                std::span<const int> candidates, Random& random) {
  std::vector<int> vertices = checked(surface, count, candidates);
  if (count == 0) return {};
  if (static_cast<std::size_t>(count) < vertices.size())
    vertices = designed(surface, design, count, vertices, random);
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

}  // namespace palpation
