#include "certainty/edge_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "belief/sites.h"
#include "certainty/depth.h"
#include "palpation/boundary/level_set.h"
#include "readings/rounding.h"

namespace palpation {
namespace {

/// Of the range, at least, where a standard deviation is given: a ridge as wide as the edge reaches
/// four fifths of its height.
constexpr double kPlateauError = 0.25;

constexpr double kRounding = 1e-13;
constexpr double kLeastVariance = 1e-300;  // has an inverse
constexpr double kDeep_m = 0.008;
/// Of what is merged far from the boundary: something else that stands out there is still seen.
constexpr double kCell_m = 0.004;

std::vector<Vec3> places_of(const Layout& layout, std::span<const SurfacePoint> points) {
  std::vector<Vec3> places;
  for (const SurfacePoint& point : points) places.push_back(layout.at(point));
  return places;
}

/// Numbers of the readings that become one: those deep on one side in one cell of space, of one
/// part.
std::vector<std::vector<std::size_t>> rows_together(const EdgeData& data, std::span<const Vec3> at,
                                                    double cell_m) {
  std::vector<std::vector<std::size_t>> rows;
  std::map<std::array<long, 5>, std::size_t> row_of_cell;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double depth = data.depth_m[static_cast<Eigen::Index>(i)];
    if (std::abs(depth) < kDeep_m) {
      rows.push_back({i});
      continue;
    }
    const Vec3 cell = (at[i] / cell_m).array().floor();
    const auto [known, is_new] =
        row_of_cell.insert({{std::lround(cell[0]), std::lround(cell[1]), std::lround(cell[2]),
                             depth > 0.0, data.part[i]},
                            rows.size()});
    if (is_new) rows.emplace_back();
    rows[known->second].push_back(i);
  }
  // In whatever order they were made.
  for (std::vector<std::size_t>& together : rows) {
    std::ranges::sort(together, {}, [&](std::size_t i) {
      return std::array{at[i].x(), at[i].y(), at[i].z(),
                        data.reading[static_cast<Eigen::Index>(i)]};
    });
  }
  return rows;
}

/// Readings and depths are means with the readings' precisions as weights.
EdgeData summed_up(const EdgeData& data, std::span<const std::vector<std::size_t>> rows) {
  const auto count = static_cast<Eigen::Index>(rows.size());
  EdgeData merged{.places = {},
                  .reading = Eigen::VectorXd::Zero(count),
                  .variance = Eigen::VectorXd::Zero(count),
                  .depth_m = Eigen::VectorXd::Zero(count),
                  .part = {},
                  .made = {},
                  .log_scatter = data.log_scatter,
                  .scatter_squares = data.scatter_squares,
                  .scatter_freedom = data.scatter_freedom};
  for (Eigen::Index row = 0; row < count; ++row) {
    const std::vector<std::size_t>& together = rows[static_cast<std::size_t>(row)];
    double precisions = 0.0;
    std::vector<Made> made;
    for (const std::size_t i : together) {
      const auto at = static_cast<Eigen::Index>(i);
      const double precision = 1.0 / data.variance[at];
      precisions += precision;
      merged.reading[row] += precision * data.reading[at];
      merged.depth_m[row] += precision * data.depth_m[at];
      made.insert(made.end(), data.made[i].begin(), data.made[i].end());
    }
    merged.reading[row] /= precisions;
    merged.depth_m[row] /= precisions;
    merged.log_scatter -= 0.5 * std::log(precisions);
    for (const std::size_t i : together) {
      const auto at = static_cast<Eigen::Index>(i);
      const double off = data.reading[at] - merged.reading[row];
      const double square = off * off / data.variance[at];
      merged.log_scatter -= 0.5 * (square + std::log(data.variance[at]));
      merged.scatter_squares += square;
    }
    merged.scatter_freedom += static_cast<double>(together.size()) - 1.0;
    merged.variance[row] = 1.0 / precisions;
    merged.places.push_back(data.places[together.front()]);
    merged.part.push_back(data.part[together.front()]);
    merged.made.push_back(std::move(made));
  }
  return merged;
}

}  // namespace

EdgeData gathered_for_edge(const Belief& belief) {
  return gathered_for_edge(belief, belief.palpations());
}

EdgeData gathered_for_edge(const Belief& belief, std::vector<Palpation> one_by_one) {
  EdgeData data;
  const std::vector<Site> sites =
      gather_sites(belief.prior(), belief.detrended(std::move(one_by_one)));
  const auto count = static_cast<Eigen::Index>(sites.size());
  data.reading.resize(count);
  data.variance.resize(count);
  data.depth_m.setZero(count);
  data.part.assign(sites.size(), 0);
  for (Eigen::Index i = 0; i < count; ++i) {
    const MergedReading merged = merge(sites[i], belief.noise_variance());
    data.places.push_back(sites[i].where);
    data.made.push_back(sites[i].made);
    data.reading[i] = merged.mean;
    data.variance[i] = merged.variance;
  }
  return data;
}

double log_evidence_without_edge(const Belief& belief) {
  EdgeData data = gathered_for_edge(belief);
  const auto count = static_cast<double>(data.reading.size());
  const double rounding = kRounding * data.reading.cwiseAbs().maxCoeff();
  data.variance = data.variance.cwiseMax(std::max(rounding * rounding, kLeastVariance));
  const Eigen::VectorXd precision = data.variance.cwiseInverse();
  const double mean = precision.dot(data.reading) / precision.sum();
  const double squares = precision.dot((data.reading.array() - mean).square().matrix());
  const double least =
                   std::max(rounding_variance(belief.palpations()), std::pow(kRounding * mean, 2)),
               scale = std::max(squares / count, least * precision.minCoeff());
  return -0.5 * (data.variance.array().log().sum() + count * std::log(scale) + squares / scale) -
         std::log(count);
}

EdgeData with_noise(double times, EdgeData data) {
  data.variance *= times;
  data.log_scatter +=
      0.5 * (data.scatter_squares * (1.0 - 1.0 / times) - data.scatter_freedom * std::log(times));
  data.scatter_squares /= times;
  return data;
}

bool measure_depths(const Layout& layout, const Field& field, double level,
                    Eigen::VectorXd& vertices, EdgeData& data) {
  const Surface& surface = layout.surface();
  const std::vector<LevelLoop> loops = level_loops(surface, field, level);
  const std::vector<double> of_vertices = distances_from(layout, loops, layout.vertices());
  const std::vector<double> of_readings =
      distances_from(layout, loops, places_of(layout, data.places));
  if (of_vertices.empty() || of_readings.empty()) return false;
  vertices.resize(surface.vertex_count());
  for (Eigen::Index vertex = 0; vertex < vertices.size(); ++vertex) {
    const double distance = of_vertices[vertex];
    vertices[vertex] = field[vertex] >= level ? distance : -distance;
  }
  for (Eigen::Index i = 0; i < data.depth_m.size(); ++i) {
    const double distance = of_readings[i];
    data.depth_m[i] = surface.interpolate(field, data.places[i]) >= level ? distance : -distance;
  }
  return true;
}

EdgeData with_plateaus_merged(const Layout& layout, const EdgeData& data) {
  if (data.reading.size() <= kMany) return data;
  const std::vector<Vec3> at = places_of(layout, data.places);
  for (double cell_m = kCell_m;; cell_m *= 1.5) {
    const std::vector<std::vector<std::size_t>> rows = rows_together(data, at, cell_m);
    const auto merged = std::ranges::count_if(rows, [](const auto& row) { return row.size() > 1; });
    if (merged <= kMany) return summed_up(data, rows);
  }
}

Vec3 travel_to(const std::vector<Made>& made) {
  Vec3 sum = Vec3::Zero();
  for (const Made& one : made) sum += one.travel;
  return sum / static_cast<double>(made.size());
}

double plateau_sd(const Belief& belief, double range) {
  return std::max(belief.signal_sd(), kPlateauError * range);
}

}  // namespace palpation
