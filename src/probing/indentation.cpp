#include "palpation/probing/indentation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "palpation/base/error.h"
#include "probing/contact_model.h"
#include "probing/loading.h"
#include "probing/robust.h"
#include "probing/words.h"

namespace palpation {
namespace {

constexpr Eigen::Index kLeastInAir = 5;
constexpr Eigen::Index kTellsContact = 5;  // samples: three degrees of freedom
constexpr double kFlat = 0.05;             // of the slope of all: in the air
constexpr double kDrifting = 0.3;          // the same, where stamps tell the drift apart
constexpr double kInAirAtSight = 1.0 / 3.0;
constexpr int kMostSamples = 400;      // for looking where contact is; fits take all
constexpr double kReach = 1.0 + 1e-9;  // a depth written in decimals may be a rounding less

void check(const Indentation& indentation, const ContactOptions& options) {
  const Eigen::Index n = indentation.depth_m.size();
  require(indentation.force.size() == n &&
              (indentation.time_s.size() == 0 || indentation.time_s.size() == n),
          "fit_contact", "the indentation", "must have as many depths, forces and times");
  require(options.least_samples >= 2, "fit_contact", std::to_string(options.least_samples),
          "samples in contact are too few: two at least");
  const auto is_length = [](double value) { return value > 0.0 && std::isfinite(value); };
  require(options.model != ContactModel::Hertz || is_length(options.indenter_radius_m),
          "fit_contact", "indenter radius " + text_of(options.indenter_radius_m),
          "must be positive and finite");
  require(options.model != ContactModel::ForceAtDepth || is_length(options.at_depth_m),
          "fit_contact", "depth " + text_of(options.at_depth_m), "must be positive and finite");
}

/// Rows spread evenly over a long loading, to look where contact is.
Loading thinned(const Loading& loading) {
  const Eigen::Index n = loading.depth_m.size();
  if (n <= kMostSamples) return loading;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < kMostSamples; ++i) rows.push_back(i * (n - 1) / (kMostSamples - 1));
  return rows_of(loading, rows);
}

/// The samples before a contact depth are flat: their slope is none that could be told from zero.
bool is_flat(const Loading& loading, double contact_m, double slope_of_all) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < loading.depth_m.size(); ++i) {
    if (loading.depth_m[i] < contact_m) rows.push_back(i);
  }
  if (static_cast<Eigen::Index>(rows.size()) < kLeastInAir) return false;
  const Loading air = rows_of(loading, rows);
  const LinearFit line = fit_at(air, {}, {}, air.depth_m.minCoeff());
  const Eigen::VectorXd centred = air.depth_m.array() - air.depth_m.mean();
  const double variance =
      line.squares / static_cast<double>(rows.size() - 2) / centred.squaredNorm();
  const double flat = loading.time_s.size() > 0 ? kDrifting : kFlat;
  return std::abs(line.coefficients[1]) <=
         std::max(3.0 * std::sqrt(variance), flat * std::abs(slope_of_all));
}

/// Whether the first samples are in the air.
bool shows_approach(const Loading& loading, const ContactOptions& options) {
  const Eigen::Index n = loading.depth_m.size();
  if (options.approach == Approach::NotRecorded || n < kLeastInAir + 3) return false;
  if (options.approach == Approach::Recorded) return true;
  const Loading few = thinned(loading);
  const Unknowns bent{.contact = true};
  const double least_m = few.depth_m.minCoeff(), most_m = few.depth_m.maxCoeff();
  const double contact_m = best_contact(few, options, bent, least_m, most_m);
  const double bend = fit_at(few, options, bent, contact_m).squares;
  const LinearFit slope = fit_at(few, {}, {}, least_m);
  if (!is_flat(few, contact_m, slope.coefficients[1])) return false;

  const double line = fit_at(few, {}, {}, least_m).squares;
  const double parabola =
      fit_at(few, {.model = ContactModel::ForceAtDepth, .at_depth_m = 1.0}, {}, least_m).squares;
  const double left = static_cast<double>(few.depth_m.size()) - 3.0;
  if (line - bend <= kBend * bend / left) return false;
  const double in_air = (few.depth_m.array() < contact_m).cast<double>().mean();
  if (parabola <= bend && in_air < kInAirAtSight) return false;
  return true;
}

struct Attempt {
  Unknowns unknowns;
  double contact_m = 0.0;
  LinearFit fit;
  Value value;
};

Attempt attempt(const Loading& loading, const ContactOptions& options) {
  Attempt best;
  const double least_m = loading.depth_m.minCoeff(), range_m = range_of(loading.depth_m);
  best.contact_m = least_m;
  if (shows_approach(loading, options)) {
    best.unknowns = {.zero = true, .drift = loading.time_s.size() > 0, .contact = true};
    best.contact_m = best_contact(loading, options, best.unknowns, least_m, least_m + range_m);
  } else if (options.model == ContactModel::Hertz) {
    best.unknowns = {.zero = false, .contact = true};
    best.contact_m = best_contact(loading, options, best.unknowns, least_m - 3.0 * range_m,
                                  least_m + 0.5 * range_m);
  }
  best.fit = fit_at(loading, options, best.unknowns, best.contact_m);
  best.value = value_of(loading, options, best.unknowns, best.contact_m, best.fit);
  return best;
}

/// The force rises with the depth by more than chance lets it. From the air: a contact that could
/// lie anywhere explains far more than none. Else the slope of a line is clear of zero; the tails
/// of Student's t are long where degrees are few.
bool rises(const Loading& loading, const ContactOptions& options, const Attempt& best) {
  const Eigen::Index own = before_own(best.unknowns), n = loading.depth_m.size();
  if (best.unknowns.zero && best.unknowns.contact) {
    const double none = fit_at(loading, options, best.unknowns, loading.depth_m.maxCoeff()).squares;
    const auto degrees = static_cast<double>(n - unknown_count(options, best.unknowns));
    return degrees > 0.0 && best.value.value > 0.0 && best.fit.coefficients[own] > 0.0 &&
           none - best.fit.squares > kBend * best.fit.squares / degrees;
  }
  const double shallowest_m = loading.depth_m.minCoeff();
  const LinearFit line = fit_at(loading, {}, {}, shallowest_m);
  const double slope_variance = value_of(loading, {}, {}, shallowest_m, line).unit_variance;
  const auto degrees = std::max(1.0, static_cast<double>(n) - 2.0);
  return line.coefficients[1] >
         (3.0 + 6.0 / degrees) * std::sqrt(line.squares / degrees * slope_variance);
}

/// What keeps a fit from being a value.
std::optional<ContactFit> fault_of(const Loading& loading, const ContactOptions& options,
                                   const Attempt& best, int left_out) {
  if (!rises(loading, options, best) && loading.depth_m.size() < kTellsContact)
    return failed(
        ContactOutcome::TooFewSamples,
        "too few samples to tell contact from noise: " + std::to_string(loading.depth_m.size()),
        left_out);
  if (!rises(loading, options, best))
    return failed(ContactOutcome::NoContact,
                  "no contact: the force does not rise with the depth above its own scatter",
                  left_out);
  const double reached_m = loading.depth_m.maxCoeff() - best.contact_m;
  if (options.model == ContactModel::ForceAtDepth && options.at_depth_m > reached_m * kReach)
    return failed(ContactOutcome::NotSoDeep,
                  "only " + in_mm(reached_m) + " deep, less than the " + in_mm(options.at_depth_m) +
                      " asked for",
                  left_out);
  const int degrees =
      static_cast<int>(loading.depth_m.size()) - unknown_count(options, best.unknowns);
  const double sd =
      degrees < 1 ? 0.0 : std::sqrt(best.value.unit_variance * best.fit.squares / degrees);
  if (!(sd < best.value.value))
    return failed(ContactOutcome::NotDetermined,
                  "the samples do not tell the model's unknowns apart: the value is no larger than "
                  "its own error",
                  left_out);
  return std::nullopt;
}

}  // namespace

ContactFit fit_contact(const Indentation& indentation, const ContactOptions& options) {
  check(indentation, options);
  Prepared prepared = prepare(indentation, options);
  if (prepared.fault) return *prepared.fault;
  Attempt best = attempt(prepared.loading, options);
  if (const auto clean = without_spikes(prepared.loading, best.fit.residuals)) {
    prepared.left_out += static_cast<int>(prepared.loading.depth_m.size() - clean->depth_m.size());
    prepared.loading = *clean;
    best = attempt(prepared.loading, options);
  }
  const auto most_left_out = std::max<Eigen::Index>(1, prepared.loading.depth_m.size() / 10);
  for (Eigen::Index i = 0; i < most_left_out; ++i) {
    const auto clean = without_misfit(
        prepared.loading, best.fit.residuals,
        leverages_of(prepared.loading, options, best.unknowns, best.contact_m, best.fit),
        unknown_count(options, best.unknowns));
    if (!clean) break;
    ++prepared.left_out;
    prepared.loading = *clean;
    best = attempt(prepared.loading, options);
  }
  if (const auto fault = fault_of(prepared.loading, options, best, prepared.left_out))
    return *fault;

  ContactFit fit;
  fit.outcome = ContactOutcome::Fitted;
  fit.value = best.value.value;
  fit.contact_depth_m = best.contact_m;
  fit.approach_seen = best.unknowns.contact && best.unknowns.zero;
  fit.samples = static_cast<int>(prepared.loading.depth_m.size());
  fit.left_out = prepared.left_out;
  fit.held = prepared.held;
  const int degrees = fit.samples - unknown_count(options, best.unknowns);
  if (degrees >= 1) fit.residual_sd = std::sqrt(best.fit.squares / degrees);
  fit.variance = best.value.unit_variance * student_variance(best.fit.squares, degrees);
  return fit;
}

}  // namespace palpation
