/// The exact posterior: a row of the factor L, and of V = L^-1 K(sites, vertices), for every site.
///
///     K + D = L L',  K the correlations, D the noise of each site over the signal's variance.
///
/// Rows are only ever appended, and shared by all beliefs that have them in common: m more sites
/// over N vertices with n sites known cost about 2 m n N operations, and 8 m N bytes.
#pragma once

#include "belief/engine.h"

namespace palpation {

class ExactEngine final : public Engine {
 public:
  /// Whether rows of V are kept, or only their sums: for a belief that is asked once.
  enum class Keep { Rows, Sums };

  /// With the last `more` of all palpations taken in; standardizes the field by all of them. Throws
  /// as Belief::condition_on.
  ExactEngine after(ScaledPrior& field, std::span<const Palpation> palpations, std::size_t more,
                    Keep keep = Keep::Rows) const;

  /// Keeps the rows that `touched`, this engine after `more` touches, has more than this one, if
  /// that is all in which they differ: they are taken when the same touches come.
  void foresee(const ExactEngine& touched, int more);
  void forget_foreseen() { foreseen_.reset(); }

  int row_count() const;

  int site_count() const override { return static_cast<int>(sites_.size()); }
  Seen look_at(const Prior& prior, const Place& place) const override;
  void unexplained(const VertexTiles& tiles, int tile, double* of_lanes) const override;
  std::vector<TileRows> rows() const override;
  std::vector<double> column(const VertexTiles& tiles, int vertex) const override;
  double held(double correlation, int a, int b) const override;
  double plus_log_determinant(double sum) const override;
  double plus_scatter(double sum, double noise_variance) const override;

 private:
  struct Foreseen;
  /// With more noise 1 - v'v is good to eleven digits at the site too.
  static constexpr double kSmallNoise = 1e-4;

  void restate_sites(ScaledPrior& field, std::span<const Palpation> palpations, std::size_t more);
  void restate_readings(const ScaledPrior& field);
  void keep_rows(const Prior& prior, int count);
  void append_foreseen(const Prior& prior);
  void append_rows(const ScaledPrior& field, Keep keep);
  void append_to_factor(const Prior& prior, FactorRows& fresh) const;
  void append_to_whitened(const Prior& prior, const FactorRows& fresh);
  void append_to_vertices(const ScaledPrior& field, FactorRows& fresh, Keep keep);
  Eigen::MatrixXd whitened_rows(int first, int count) const;
  Eigen::VectorXd solve_lower(Eigen::VectorXd right_side) const;
  void sharpen(const Prior& prior);
  void sharpen_beside(const Prior& prior, std::span<const Eigen::VectorXd> g,
                      std::span<const Eigen::VectorXd> v, std::span<const double> there);

  std::vector<Site> sites_;
  int repeat_count_ = 0;          // of them, places that an earlier one has too
  std::vector<double> readings_;  // merged, one per site
  std::vector<double> diagonal_;  // D
  double least_noise_ = 1.0;      // in it
  std::vector<std::shared_ptr<const FactorRows>> rows_;
  Field sharp_;  // 1 - v'v at the vertices with its digits kept, or empty where none are in danger
  std::shared_ptr<const Foreseen> foreseen_;
};

}  // namespace palpation
