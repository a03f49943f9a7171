#include "belief/foreseen.h"

#include <algorithm>
#include <utility>

#include "belief/reduced.h"
#include "belief/vertex_tiles.h"
#include "palpation/base/parallel.h"

namespace palpation {

Belief Belief::foresee(std::span<const SurfacePoint> places) const {
  Belief next = *this;
  next.foreseen_.reset();
  // The signal of standardized readings changes with every one: rows for it would be those of
  // another noise.
  const bool keeps_noise = !options_.standardize || options_.noise_is_relative;
  if (places.empty() || reduced_ || !keeps_noise) return next;
  // One value is like another here; the origin is that of the readings, if there are any.
  std::vector<Palpation> supposed(places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    supposed[i] = {.where = places[i], .reading = centre_};
  const Belief touched = next.condition_on(supposed);
  const bool only_grew = !touched.reduced_ &&
                         touched.site_count() == site_count() + static_cast<int>(places.size()) &&
                         touched.rows_.size() == rows_.size() + 1 &&
                         std::equal(rows_.begin(), rows_.end(), touched.rows_.begin());
  if (!only_grew) return next;
  Foreseen foreseen{
      .places = {}, .diagonal = {}, .rows = touched.rows_.back(), .sums = touched.sums_};
  for (int site = site_count(); site < touched.site_count(); ++site) {
    foreseen.places.push_back(touched.sites_[site].place);
    foreseen.diagonal.push_back(touched.diagonal_[site]);
  }
  next.foreseen_ = std::make_shared<const Foreseen>(std::move(foreseen));
  return next;
}

/// If the first sites without rows are those foreseen, takes their rows; what is left is what their
/// readings add to the mean.
void Belief::append_foreseen() {
  const std::shared_ptr<const Foreseen> foreseen = std::exchange(foreseen_, nullptr);
  if (!foreseen) return;
  const int first = foreseen->rows->first, count = foreseen->rows->count;
  if (row_count() != first || site_count() < first + count) return;
  for (int i = 0; i < count; ++i) {
    if (!(sites_[first + i].place == foreseen->places[i]) ||
        diagonal_[first + i] != foreseen->diagonal[i])
      return;
  }
  append_to_solutions(*foreseen->rows);
  const Eigen::VectorXd minus_whitened = -whitened_.segment(first, count);
  const int tile_count = prior_.tiles().count();
  auto sums = std::make_shared<Sums>(tile_count, sum_rows());
  for_ranges(tile_count, 512, [&](int begin, int end) {
    const AlignedDoubles widened =
        aligned_doubles(static_cast<std::size_t>(foreseen->rows->per_tile()));
    for (int tile = begin; tile < end; ++tile) {
      double* sum = sums->tile(tile);
      std::copy_n(foreseen->sums->tile(tile), sums->width * kLanes, sum);
      double* whitened = sum + Sums::kWhitened * kLanes;
      if (sums_) {
        std::copy_n(sums_->tile(tile) + Sums::kWhitened * kLanes, kLanes, whitened);
      } else {
        std::fill_n(whitened, kLanes, 0.0);
      }
      subtract_product(minus_whitened.data(), count, foreseen->rows->tile(tile, widened.get()),
                       count, whitened, 1);
    }
  });
  sums_ = std::move(sums);
  rows_.push_back(foreseen->rows);
}

}  // namespace palpation
