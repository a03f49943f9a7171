#include "probing/loading.h"

#include <algorithm>
#include <cmath>

#include "palpation/base/error.h"
#include "probing/robust.h"

namespace palpation {
namespace {

constexpr double kHold = 0.02;     // of the depth's range: the rest of a hold is no loading
constexpr double kReversal = 0.1;  // of the depth's range: what shakes less is no reversal
constexpr int kMostReversals = 2;
constexpr double kSpike = 6.0;       // robust standard deviations
constexpr double kMisfit = 5.0;      // of a normal: a sample in two million
constexpr double kLeastFree = 1e-6;  // of a sample's force: less is fitted exactly
constexpr double kLoneJump = 4.0;    // times any other step from sample to sample
// Of so many samples with noise alone, three in ten thousand have such a step; of eight, four in a
// thousand.
constexpr Eigen::Index kTellsJump = 12;
constexpr int kLeastStuck = 3;
constexpr double kDeeper = 0.05;    // of the depth's range, while the force stays
constexpr double kShortfall = 6.0;  // standard deviations that a stuck force falls behind

Loading head_of(const Loading& loading, Eigen::Index count) {
  return {loading.depth_m.head(count), loading.force.head(count),
          loading.time_s.size() == 0 ? Eigen::VectorXd() : loading.time_s.head(count).eval()};
}

Loading finite_rows(const Indentation& indentation) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < indentation.depth_m.size(); ++i) {
    if (std::isfinite(indentation.depth_m[i]) && std::isfinite(indentation.force[i]))
      rows.push_back(i);
  }
  Loading finite = rows_of({indentation.depth_m, indentation.force, indentation.time_s}, rows);
  if (!finite.time_s.allFinite()) finite.time_s.resize(0);
  return finite;
}

Loading without_row(const Loading& loading, Eigen::Index row) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < loading.depth_m.size(); ++i)
    if (i != row) rows.push_back(i);
  return rows_of(loading, rows);
}

/// The Student's t that is exceeded as seldom as a normal's deviate (Wallace 1959).
double student_as_rare_as(double deviate, double degrees) {
  const double stretched = deviate * (8.0 * degrees + 3.0) / (8.0 * degrees + 1.0);
  return std::sqrt(degrees * std::expm1(stretched * stretched / degrees));
}

/// How often the depth turns by more than it shakes.
int reversals(const Eigen::VectorXd& depth_m) {
  const double enough_m = kReversal * range_of(depth_m);
  int count = 0, heading = 0;
  double turn_m = depth_m[0];
  for (const double here_m : depth_m) {
    if (heading >= 0 && here_m > turn_m) turn_m = here_m, heading = 1;
    if (heading <= 0 && here_m < turn_m) turn_m = here_m, heading = -1;
    if (std::abs(here_m - turn_m) <= enough_m) continue;
    heading = here_m > turn_m ? 1 : -1;
    turn_m = here_m;
    ++count;
  }
  return count;
}

/// Up to the first sample that is as good as the deepest; or, where a log begins deep, from there
/// on: an indentation told backwards.
Loading loading_of(const Loading& all, int least_samples) {
  const double deep_m = all.depth_m.maxCoeff() - kHold * range_of(all.depth_m);
  Eigen::Index first = 0, last = all.depth_m.size() - 1;
  while (all.depth_m[first] < deep_m) ++first;
  while (all.depth_m[last] < deep_m) --last;
  if (first + 1 >= least_samples || all.depth_m.size() - last <= first + 1) {
    Eigen::Index deepest = first;  // of the samples that still go down
    while (deepest + 1 < all.depth_m.size() && all.depth_m[deepest + 1] > all.depth_m[deepest])
      ++deepest;
    return head_of(all, deepest + 1);
  }
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = all.depth_m.size() - 1; i >= last; --i) rows.push_back(i);
  return rows_of(all, rows);
}

/// The sample that stands off both neighbours, or at an end off its only one, by more than any two
/// others that are as far apart in depth; -1 for none. A fit that looks for the contact would take
/// one at the end for the tissue.
Eigen::Index lone_jump(const Loading& loading) {
  const Eigen::Index n = loading.force.size();
  if (n < kTellsJump) return -1;
  const Eigen::VectorXd steps = loading.force.tail(n - 1) - loading.force.head(n - 1);
  const Eigen::VectorXd ways_m =
      (loading.depth_m.tail(n - 1) - loading.depth_m.head(n - 1)).cwiseAbs();
  const double usual_m = median_of({ways_m.begin(), ways_m.end()});
  Eigen::Index largest = 0;
  steps.cwiseAbs().maxCoeff(&largest);
  for (const Eigen::Index sample : {largest, largest + 1}) {
    double others = 0.0, own = std::abs(steps[largest]), way_m = ways_m[largest];
    for (Eigen::Index i = 0; i < n - 1; ++i)
      if (i != sample && i + 1 != sample) others = std::max(others, std::abs(steps[i]));
    if (sample > 0 && sample < n - 1) {
      if (steps[sample - 1] * steps[sample] > 0.0) continue;
      own = std::min(std::abs(steps[sample - 1]), std::abs(steps[sample]));
      way_m = std::max(ways_m[sample - 1], ways_m[sample]);
    }
    if (own > kLoneJump * others * std::max(1.0, way_m / usual_m)) return sample;
  }
  return -1;
}

/// How many samples at the end hold one force, to the last digit, while the probe goes deeper.
Eigen::Index stuck_at_end(const Loading& loading) {
  const Eigen::Index n = loading.depth_m.size();
  Eigen::Index count = 1;
  while (count < n && loading.force[n - 1 - count] == loading.force[n - 1]) ++count;
  const double deeper_m = loading.depth_m[n - 1] - loading.depth_m[n - count];
  return count >= kLeastStuck && deeper_m > kDeeper * range_of(loading.depth_m) ? count : 0;
}

/// A line from a depth on: what was felt before is the air's.
struct Rise {
  double from_m;
  LinearFit fit;
  double at(double depth_m) const {
    return fit.coefficients[0] + fit.coefficients[1] * (depth_m - from_m);
  }
};

/// From where the force clearly bends, if it does, else from the shallowest sample on.
Rise rise_of(const Loading& loading) {
  const double least_m = loading.depth_m.minCoeff(), most_m = loading.depth_m.maxCoeff();
  const LinearFit line = fit_at(loading, {}, {}, least_m);
  const double left = static_cast<double>(loading.depth_m.size()) - 3.0;
  if (left < kLeastStuck) return {least_m, line};
  const Unknowns bent{.contact = true};
  const double contact_m = best_contact(loading, {}, bent, least_m, most_m);
  const LinearFit bend = fit_at(loading, {}, bent, contact_m);
  const bool bends = line.squares - bend.squares > kBend * bend.squares / left;
  return bends ? Rise{contact_m, bend} : Rise{least_m, line};
}

/// Whether the force that the other samples foretell leaves the one that stays.
bool falls_behind(const Loading& loading, Eigen::Index stuck) {
  Loading before = head_of(loading, loading.depth_m.size() - stuck);
  if (before.depth_m.size() < 3 || range_of(before.depth_m) == 0.0) return true;
  Rise rise = rise_of(before);
  if (const auto clean = without_spikes(before, rise.fit.residuals)) {
    before = *clean;
    rise = rise_of(before);
  }
  const Eigen::Index last = loading.depth_m.size() - 1;
  const double foretold = rise.at(loading.depth_m[last]);
  const auto degrees = std::max(1.0, static_cast<double>(before.depth_m.size()) - 2.0);
  return foretold - loading.force[last] > kShortfall * std::sqrt(rise.fit.squares / degrees);
}

}  // namespace

double range_of(const Eigen::VectorXd& values) {
  return values.size() == 0 ? 0.0 : values.maxCoeff() - values.minCoeff();
}

Loading rows_of(const Loading& loading, const std::vector<Eigen::Index>& rows) {
  return {loading.depth_m(rows), loading.force(rows),
          loading.time_s.size() == 0 ? Eigen::VectorXd() : Eigen::VectorXd(loading.time_s(rows))};
}

/// The loading without single samples far off the fit; nothing where there are none.
std::optional<Loading> without_spikes(const Loading& loading, const Eigen::VectorXd& residuals) {
  if (loading.depth_m.size() < 8) return std::nullopt;
  const double far = kSpike * robust_sd(residuals);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < residuals.size(); ++i) {
    if (std::abs(residuals[i]) <= far) rows.push_back(i);
  }
  const auto spikes = residuals.size() - static_cast<Eigen::Index>(rows.size());
  if (spikes == 0 || 10 * spikes > residuals.size() || far == 0.0) return std::nullopt;
  return rows_of(loading, rows);
}

/// By residuals over the standard deviation that the others have without them: where the noise is
/// Gaussian, these are Student's t, the fit's own pull on each undone.
std::optional<Loading> without_misfit(const Loading& loading, const Eigen::VectorXd& residuals,
                                      const Eigen::VectorXd& leverages, int unknowns) {
  const Eigen::Index n = loading.depth_m.size();
  const double degrees = double(n - unknowns) - 1.0;
  if (n < 8 || degrees < 3.0) return std::nullopt;
  const double squares = residuals.squaredNorm();
  Eigen::Index worst = -1;
  double most = student_as_rare_as(kMisfit, degrees);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double free = 1.0 - leverages[i];
    if (free < kLeastFree) continue;
    const double own = residuals[i] * residuals[i] / free;
    const double others = std::max(squares - own, 1e-12 * squares) / degrees;
    if (!(std::sqrt(own / others) > most)) continue;
    most = std::sqrt(own / others);
    worst = i;
  }
  if (worst < 0) return std::nullopt;
  return without_row(loading, worst);
}

ContactFit failed(ContactOutcome outcome, const std::string& reason, int left_out) {
  ContactFit fit;
  fit.outcome = outcome;
  fit.reason = reason;
  fit.left_out = left_out;
  return fit;
}

Prepared prepare(const Indentation& indentation, const ContactOptions& options) {
  const Loading finite = finite_rows(indentation);
  Prepared prepared;
  prepared.left_out = static_cast<int>(indentation.depth_m.size() - finite.depth_m.size());
  const auto fault = [&](ContactOutcome outcome, const std::string& reason) {
    prepared.fault = failed(outcome, reason, prepared.left_out);
    return prepared;
  };
  const auto too_few = [&](Eigen::Index count) {
    return fault(ContactOutcome::TooFewSamples,
                 "too few samples: " + std::to_string(count) + ", and " +
                     std::to_string(options.least_samples) + " are needed");
  };
  if (finite.depth_m.size() < options.least_samples) return too_few(finite.depth_m.size());
  if (range_of(finite.depth_m) <= 0.0)
    return fault(ContactOutcome::NotMonotone, "the depth stays the same");
  if (range_of(finite.force) <= 0.0)
    return fault(ContactOutcome::Stuck,
                 "the force is stuck at " + text_of(finite.force[0]) + " in every sample");
  if (const int turns = reversals(finite.depth_m); turns > kMostReversals)
    return fault(ContactOutcome::NotMonotone, "the depth goes to and fro (" +
                                                  std::to_string(turns) +
                                                  " turns): one indentation goes in and comes out");
  prepared.loading = loading_of(finite, options.least_samples);
  if (prepared.loading.depth_m.size() < options.least_samples)
    return too_few(prepared.loading.depth_m.size());
  if (const Eigen::Index jump = lone_jump(prepared.loading); jump >= 0) {
    ++prepared.left_out;
    prepared.loading = without_row(prepared.loading, jump);
  }
  const Eigen::Index stuck = stuck_at_end(prepared.loading);
  if (stuck > 0 && falls_behind(prepared.loading, stuck)) {
    prepared.left_out += static_cast<int>(stuck);
    const double held = prepared.held = prepared.loading.force[prepared.loading.force.size() - 1];
    prepared.loading = head_of(prepared.loading, prepared.loading.depth_m.size() - stuck);
    if (prepared.loading.depth_m.size() < options.least_samples ||
        range_of(prepared.loading.force) <= 0.0) {
      fault(ContactOutcome::Stuck, "the force stays at " + text_of(held) +
                                       " while the probe goes deeper: saturated or stuck");
      prepared.fault->held = held;
    }
  }
  return prepared;
}

}  // namespace palpation
