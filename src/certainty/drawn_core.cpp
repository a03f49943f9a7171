#include "certainty/drawn_core.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

namespace palpation {
namespace {

/// The vertex that lies nearest to the middle of those that so many draws have in the core.
int middle_of(const Surface& surface, const std::vector<int>& times) {
  const int often = *std::ranges::max_element(times) / 2;
  Vec3 middle = Vec3::Zero();
  double area = 0.0;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    if (times[vertex] <= often) continue;
    middle += surface.vertex_areas()[vertex] * surface.vertex(vertex);
    area += surface.vertex_areas()[vertex];
  }
  middle /= area;
  int nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    const double square = (surface.vertex(vertex) - middle).squaredNorm();
    if (times[vertex] > often && square < least)
      std::tie(nearest, least) = std::pair(vertex, square);
  }
  return nearest;
}

}  // namespace

DrawnNumber summed_up(std::vector<double> numbers) {
  std::ranges::sort(numbers);
  const auto count = numbers.size();
  DrawnNumber sum{.least = numbers[count / 40], .most = numbers[count - 1 - count / 40]};
  for (const double number : numbers) sum.mean += number / static_cast<double>(count);
  return sum;
}

std::optional<DrawnCore> core_of(const Surface& surface, const std::vector<OutlineDraw>& draws,
                                 const Eigen::MatrixXf& depths) {
  std::vector<double> areas, beside, with, without;
  std::vector<int> times(static_cast<std::size_t>(surface.vertex_count()), 0);
  for (std::size_t draw = 0; draw < draws.size(); ++draw) {
    const auto depth = depths.row(static_cast<Eigen::Index>(draw)).transpose().array();
    (draws[draw].profile.core ? with : without)
        .push_back((depth >= 0.0F).select(surface.vertex_areas().array(), 0.0).sum());
    if (!draws[draw].profile.core) continue;
    const ReadingLaw& law = draws[draw].law;
    double area = 0.0;
    for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
      const Vec2 place = surface.chart().uv.row(vertex).transpose();
      if (depth[vertex] < 0.0F || law.in_core.depth_at(place) < 0.0) continue;
      area += surface.vertex_areas()[vertex];
      ++times[vertex];
    }
    areas.push_back(area);
    beside.push_back(law.core->beside);
  }
  if (std::ranges::count(times, 0) == surface.vertex_count()) return std::nullopt;
  const double probability = static_cast<double>(areas.size()) / static_cast<double>(draws.size());
  return DrawnCore{.where = surface.at_vertex(middle_of(surface, times)),
                   .area_m2 = summed_up(std::move(areas)),
                   .beside = summed_up(std::move(beside)),
                   .with_m2 = summed_up(std::move(with)).mean,
                   .without_m2 = without.empty() ? 0.0 : summed_up(std::move(without)).mean,
                   .probability = probability};
}

}  // namespace palpation
