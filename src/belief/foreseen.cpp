#include <algorithm>
#include <utility>

#include "belief/exact_engine.h"
#include "palpation/base/parallel.h"

namespace palpation {

/// Rows of touches that are planned but not yet made.
struct ExactEngine::Foreseen {
  std::vector<Place> places;
  std::vector<double> diagonal;
  std::shared_ptr<const FactorRows> rows;
  std::shared_ptr<const VertexSums> sums;  // of readings without meaning: all but these count
};

void ExactEngine::foresee(const ExactEngine& touched, int more) {
  const bool only_grew = touched.site_count() == site_count() + more &&
                         touched.rows_.size() == rows_.size() + 1 &&
                         std::equal(rows_.begin(), rows_.end(), touched.rows_.begin());
  if (!only_grew) return;
  Foreseen foreseen{
      .places = {}, .diagonal = {}, .rows = touched.rows_.back(), .sums = touched.sums_};
  for (int site = site_count(); site < touched.site_count(); ++site) {
    foreseen.places.push_back(touched.sites_[site].place);
    foreseen.diagonal.push_back(touched.diagonal_[site]);
  }
  foreseen_ = std::make_shared<const Foreseen>(std::move(foreseen));
}

/// If the first sites without rows are those foreseen, takes their rows; what is left is what their
/// readings add to the mean.
void ExactEngine::append_foreseen(const Prior& prior) {
  const std::shared_ptr<const Foreseen> foreseen = std::exchange(foreseen_, nullptr);
  if (!foreseen) return;
  const int first = foreseen->rows->first, count = foreseen->rows->count;
  if (row_count() != first || site_count() < first + count) return;
  for (int i = 0; i < count; ++i) {
    if (!(sites_[first + i].place == foreseen->places[i]) ||
        diagonal_[first + i] != foreseen->diagonal[i])
      return;
  }
  append_to_whitened(prior, *foreseen->rows);
  const Eigen::VectorXd minus_readings = -whitened_.readings.segment(first, count);
  const int tile_count = prior.tiles().count();
  auto sums = std::make_shared<VertexSums>(tile_count, prior.has_slope());
  for_ranges(tile_count, 512, [&](int begin, int end) {
    const AlignedDoubles widened =
        aligned_doubles(static_cast<std::size_t>(foreseen->rows->per_tile()));
    for (int tile = begin; tile < end; ++tile) {
      double* sum = sums->tile(tile);
      std::copy_n(foreseen->sums->tile(tile), sums->width * kLanes, sum);
      double* readings = sum + VertexSums::kReadings * kLanes;
      if (sums_) {
        std::copy_n(sums_->tile(tile) + VertexSums::kReadings * kLanes, kLanes, readings);
      } else {
        std::fill_n(readings, kLanes, 0.0);
      }
      subtract_product(minus_readings.data(), count, foreseen->rows->tile(tile, widened.get()),
                       count, readings, 1);
    }
  });
  sums_ = std::move(sums);
  rows_.push_back(foreseen->rows);
}

}  // namespace palpation
