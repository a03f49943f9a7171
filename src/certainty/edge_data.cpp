#include "certainty/edge_data.h"

#include <cmath>
#include <optional>

#include "belief/sites.h"
#include "certainty/depth.h"
#include "palpation/boundary/level_set.h"

namespace palpation {
namespace {

constexpr double kDeep_m = 0.008;

std::vector<Vec3> places_of(const Layout& layout, std::span<const SurfacePoint> points) {
  std::vector<Vec3> places;
  for (const SurfacePoint& point : points) places.push_back(layout.at(point));
  return places;
}

}  // namespace

EdgeData gathered_for_edge(const Belief& belief) {
  EdgeData data;
  const std::vector<Site> sites = gather_sites(belief.prior(), belief.detrended_palpations());
  const auto count = static_cast<Eigen::Index>(sites.size());
  data.reading.resize(count);
  data.variance.resize(count);
  data.depth_m.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const MergedReading merged = merge(sites[i], belief.noise_variance());
    data.places.push_back(sites[i].where);
    data.batches.push_back(sites[i].batches);
    data.reading[i] = merged.mean;
    data.variance[i] = merged.variance;
  }
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

EdgeData with_plateaus_merged(const EdgeData& data) {
  if (data.reading.size() <= kMany) return data;
  struct Plateau {
    std::optional<SurfacePoint> place;
    double precision = 0.0, reading = 0.0, depth_m = 0.0;
    std::vector<int> batches{};
  };
  Plateau plateaus[2];
  EdgeData merged;
  std::vector<double> reading, variance, depth_m;
  for (Eigen::Index i = 0; i < data.reading.size(); ++i) {
    const SurfacePoint& place = data.places[i];
    if (std::abs(data.depth_m[i]) < kDeep_m) {
      merged.places.push_back(place);
      merged.batches.push_back(data.batches[i]);
      reading.push_back(data.reading[i]);
      variance.push_back(data.variance[i]);
      depth_m.push_back(data.depth_m[i]);
      continue;
    }
    Plateau& plateau = plateaus[data.depth_m[i] > 0.0];
    const double precision = 1.0 / data.variance[i];
    if (!plateau.place) plateau.place = place;
    plateau.precision += precision;
    plateau.reading += precision * data.reading[i];
    plateau.depth_m += precision * data.depth_m[i];
    plateau.batches.insert(plateau.batches.end(), data.batches[i].begin(), data.batches[i].end());
  }
  for (const Plateau& plateau : plateaus) {
    if (!plateau.place) continue;
    merged.places.push_back(*plateau.place);
    merged.batches.push_back(plateau.batches);
    reading.push_back(plateau.reading / plateau.precision);
    variance.push_back(1.0 / plateau.precision);
    depth_m.push_back(plateau.depth_m / plateau.precision);
  }
  const auto vector_of = [](const std::vector<double>& values) {
    return Eigen::VectorXd(
        Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
  };
  merged.reading = vector_of(reading);
  merged.variance = vector_of(variance);
  merged.depth_m = vector_of(depth_m);
  return merged;
}

}  // namespace palpation
