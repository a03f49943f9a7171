#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "certainty/edge_belief_fit.h"
#include "certainty/misfit_rival.h"

namespace palpation {
namespace {

/// Of the most that a reading changes with its depth: those that change by less tell of no edge.
constexpr double kAtEdge = 0.01;
constexpr double kJitter = 1e-9;    // of the largest variance
constexpr int kMostWild = 3;        // readings that tell nothing, of those since
constexpr double kWild = 10.0;      // contrasts: as far as they may read
constexpr std::size_t kSpans = 10;  // of the readings, in time, where there is one session

/// When another outline may have begun: with each session but the first; where there is one, with
/// each tenth of the readings.
std::vector<Misfit> moments_of(const EdgeData& data) {
  std::vector<Made> all;
  for (const std::vector<Made>& made : data.made) all.insert(all.end(), made.begin(), made.end());
  std::ranges::sort(all, {},
                    [](const Made& one) { return std::tuple(one.session, one.batch, one.number); });
  std::vector<Misfit> moments;
  const auto begin = [&](const Made& first, int session) {
    moments.push_back({.kind = MisfitKind::Outline,
                       .from_batch = first.batch,
                       .number = first.number,
                       .session = session});
  };
  if (all.empty()) return moments;
  if (all.front().session == all.back().session) {
    for (std::size_t span = 1; span < kSpans; ++span) begin(all[span * all.size() / kSpans], 0);
    return moments;
  }
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].session != all[i - 1].session) begin(all[i], all[i].session);
  }
  return moments;
}

/// An outline of their own that some readings have: the correction's prior (edge_belief.h) again,
/// at the rows where it changes readings.
class OwnOutline {
 public:
  OwnOutline(const ExplainedReadings& rows, const Prior& correction)
      : by_depth_(rows.fit.by_depth) {
    const double most = by_depth_.cwiseAbs().maxCoeff();
    for (Eigen::Index row = 0; row < by_depth_.size(); ++row) {
      if (std::abs(by_depth_[row]) > kAtEdge * most) at_.push_back(row);
    }
    if (at_.empty()) return;
    std::vector<SurfacePoint> places;
    for (const Eigen::Index row : at_)
      places.push_back(rows.data.places[static_cast<std::size_t>(row)]);
    Eigen::MatrixXd prior = correction.covariance(places, places);
    prior.diagonal().array() += kJitter * prior.diagonal().maxCoeff();
    root_ = prior.llt().matrixL();
    inverse_.resize(size(), size());
    for (Eigen::Index i = 0; i < size(); ++i) {
      const Eigen::VectorXd solved =
          rows.fit.covariance.solve(Eigen::VectorXd::Unit(by_depth_.size(), at_[i]));
      inverse_.col(i) = solved(at_);
    }
  }

  /// No reading tells of an edge.
  bool is_untold() const { return at_.empty(); }

  /// Of readings by how much they are `since`, each row; its evidence against none, amount and
  /// place. `asks_most`: the row that asks the most for it.
  Misfit weighed(const ExplainedReadings& rows, const Eigen::VectorXd& since, Misfit rival,
                 Eigen::Index* asks_most = nullptr) const {
    Eigen::MatrixXd inverse = inverse_;
    for (const Eigen::VectorXd& known : rows.also) inverse -= known(at_) * known(at_).transpose();
    const Eigen::VectorXd change = by_depth_.cwiseProduct(since)(at_);
    const Eigen::MatrixXd columns = change.asDiagonal() * root_;
    Eigen::MatrixXd inner = columns.transpose() * inverse * columns;
    inner.diagonal().array() += 1.0;
    const Eigen::LLT<Eigen::MatrixXd> factor(inner);
    const Eigen::VectorXd pull = rows.pull(at_), b = columns.transpose() * pull,
                          weights = factor.solve(b);
    const double before = rows.residual.dot(rows.pull), after = before - b.dot(weights);
    rival.evidence = after > 0.0
                         ? rows.log_weight +
                               0.5 * static_cast<double>(since.size()) * std::log(before / after) -
                               factor.matrixLLT().diagonal().array().log().sum()
                         : -std::numeric_limits<double>::infinity();
    const Eigen::VectorXd deeper = root_ * weights;
    Eigen::Index felt_most = 0;
    deeper.cwiseProduct(change).cwiseAbs().maxCoeff(&felt_most);
    if (asks_most != nullptr) {
      Eigen::Index most = 0;
      deeper.cwiseProduct(change).cwiseProduct(pull).maxCoeff(&most);
      *asks_most = at_[most];
    }
    rival.amount = deeper[felt_most];
    rival.rms = std::sqrt(deeper.squaredNorm() / static_cast<double>(size()));
    rival.where = rows.data.places[static_cast<std::size_t>(at_[felt_most])];
    return rival;
  }

 private:
  Eigen::Index size() const { return static_cast<Eigen::Index>(at_.size()); }

  Eigen::VectorXd by_depth_;
  std::vector<Eigen::Index> at_;
  Eigen::MatrixXd root_;     // of its prior covariance
  Eigen::MatrixXd inverse_;  // C^-1, of these rows
};

/// Those since may have a zero and a gain of their own.
void add_zero_and_gain(const Eigen::VectorXd& since, ExplainedReadings& rows) {
  rows.add(rows.contrast * since);
  rows.add(rows.contrast * since.cwiseProduct(rows.share));
}

/// As readings show it that are left when the few that ask the most for it tell nothing.
Misfit beside_wild(const OwnOutline& own, ExplainedReadings rows, const Eigen::VectorXd& since,
                   const Misfit& moment) {
  Eigen::Index wild = 0;
  for (int i = 0; i < kMostWild; ++i) {
    own.weighed(rows, since, moment, &wild);
    rows.add(kWild * rows.contrast * Eigen::VectorXd::Unit(since.size(), wild));
  }
  return own.weighed(rows, since, moment);
}

}  // namespace

std::optional<Misfit> EdgeBelief::outline_since(std::span<const Misfit> taken_back,
                                                double false_alarms) const {
  RivalKind others;
  for (const auto& one : fits_) {
    ExplainedReadings rows(surface_, one->edge, one->data, profile_,
                           one->weight / most_likely().weight);
    for (const Misfit& change : taken_back) {
      if (change.kind == MisfitKind::Zero || change.kind == MisfitKind::Gain)
        add_zero_and_gain(part_since(one->data, change), rows);
    }
    const OwnOutline own(rows, one->correction);
    if (own.is_untold() || !std::isfinite(rows.log_weight)) continue;
    // Where the outline fits nobody's readings, those since are no others.
    const double of_all =
        own.weighed(rows, Eigen::VectorXd::Ones(rows.depth.size()), {}).evidence - rows.log_weight;
    for (const Misfit& moment : moments_of(one->data)) {
      const Eigen::VectorXd since = part_since(one->data, moment);
      ExplainedReadings beside = rows;
      add_zero_and_gain(since, beside);
      Misfit rival = beside_wild(own, std::move(beside), since, moment);
      rival.evidence -= std::max(of_all, 0.0);
      others.add(rival);
    }
  }
  std::optional<Misfit> found = others.verdict();
  if (found && !(found->evidence > surprising(false_alarms))) found.reset();
  return found;
}

}  // namespace palpation
