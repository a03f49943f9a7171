/// The posterior of reduced rank: many readings in few numbers. Once M < n features f tell the
/// prior apart from itself by no more than a tolerance of its variance at every vertex and every
/// site (features.h), readings are taken in by their features alone (weight_space.h),
///
///     variance = signal^2 (1 - |f|^2 + f' A^-1 f),  A = I + sum f f' / d,
///
/// so that m more cost 2 m M N operations whatever n is. Smooth kernels need few features (for a
/// squared exponential some hundreds over fifteen lengths at 1e-12), rough ones too many: those
/// stay exact, and so do few readings, and any of less noise than kLeastNoiseForReducedRank
/// tolerances.
#pragma once

#include "belief/engine.h"
#include "belief/features.h"
#include "belief/weight_space.h"

namespace palpation {

class ReducedEngine final : public Engine {
 public:
  /// So few readings are never worth reducing.
  static constexpr std::size_t kFewSites = 64;

  /// Of these sites, whose readings are counted from `origin`; with features that are known
  /// already, where given and enough. Null where the exact engine is to take the sites.
  static std::shared_ptr<const ReducedEngine> of(const ScaledPrior& field,
                                                 std::span<const Site> sites, double origin,
                                                 const std::shared_ptr<const Features>& known);
  static bool are_noisy(const ScaledPrior& field, std::span<const Site> sites);

  /// With more; null where these need features that there are none of, are too sharp, or the noise
  /// is not what it was.
  std::shared_ptr<const ReducedEngine> with(const ScaledPrior& field,
                                            std::span<const Site> sites) const;

  const std::shared_ptr<const Features>& features() const { return features_; }
  /// What is lost, where the greatest variance at a vertex is this.
  ReducedRank loss(const ScaledPrior& field, const Regression& regression,
                   double greatest_variance) const;

  /// Each call of condition_on counts a place anew.
  int site_count() const override { return site_count_; }
  Seen look_at(const Prior& prior, const Place& place) const override;
  void unexplained(const VertexTiles& tiles, int tile, double* of_lanes) const override;
  std::vector<TileRows> rows() const override { return {features_->rows()}; }
  std::vector<double> column(const VertexTiles& tiles, int vertex) const override;
  double plus_log_determinant(double sum) const override {
    return sum + weights_.log_determinant();
  }
  double plus_scatter(double sum, double) const override { return sum + scatter_; }

 private:
  struct Regressors;
  static Regressors regressors(const ScaledPrior& field, std::span<const Site> sites,
                               double origin);

  ReducedEngine(const ScaledPrior& field, std::span<const Site> sites,
                std::shared_ptr<const Features> features, const Regressors& readings,
                double origin);
  void restate_whitened(bool has_slope);
  void see_all(const Prior& prior);
  void see(const Prior& prior, const WeightSpace::Rows& rows);

  std::shared_ptr<const Features> features_;
  WeightSpace weights_;
  int site_count_;
  double signal_sd_;       // that the noise is counted in
  bool noise_keeps_pace_;  // with the signal's: all relative to it
  double precision_;       // sum 1 / d
  double scatter_;         // log likelihood of the readings given those merged
};

}  // namespace palpation
