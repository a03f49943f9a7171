#include "palpation/probing/probings.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "palpation/base/error.h"
#include "probing/probing_axis.h"
#include "probing/robust.h"
#include "probing/words.h"

namespace palpation {
namespace {

constexpr double kDeepest_m = 0.2;    // approach and all
constexpr double kFarAway_m = 2.0;    // tissue is at most that across
constexpr double kSameForce = 1e-9;   // of itself: axes differ in their last digits
constexpr double kOtherUnit = 300.0;  // times the usual depth, or a part of it: mm for m

struct Scale {
  double factor;  ///< from SI
  std::string unit;
};

Scale scale_of(ContactModel model, const std::string& force_unit) {
  if (model == ContactModel::ForceAtDepth) return {1.0, force_unit};
  if (model == ContactModel::Linear) return {1e-3, force_unit + "/mm"};
  return force_unit == "N" ? Scale{1e-3, "kPa"} : Scale{1e-6, force_unit + "/mm2"};
}

/// The median of the finite rows; not a number where there is none.
Vec3 median_point(const Points& points, const std::vector<Eigen::Index>& rows) {
  Vec3 middle;
  for (int k = 0; k < 3; ++k) {
    std::vector<double> values;
    for (const Eigen::Index row : rows)
      if (points.row(row).allFinite()) values.push_back(points(row, k));
    middle[k] = median_of(std::move(values));
  }
  return middle;
}

double range_of(const Eigen::VectorXd& values) {
  double least = INFINITY, most = -INFINITY;
  for (const double value : values)
    if (std::isfinite(value)) least = std::min(least, value), most = std::max(most, value);
  return most >= least ? most - least : 0.0;
}

/// Where the probe was when it was so deep: between the two samples around, on the way in; beyond
/// all of them at the nearest.
Vec3 place_at_depth(const RobotLog& log, const AxialProbing& probing, double depth_m) {
  std::vector<Eigen::Index> used;
  for (std::size_t i = 0; i < probing.rows.size(); ++i) {
    const double here_m = probing.indentation.depth_m[static_cast<Eigen::Index>(i)];
    if (std::isfinite(here_m) && log.position_m.row(probing.rows[i]).allFinite())
      used.push_back(static_cast<Eigen::Index>(i));
  }
  const auto place = [&](Eigen::Index i) {
    return Vec3(log.position_m.row(probing.rows[static_cast<std::size_t>(i)]));
  };
  if (used.empty()) return Vec3::Constant(std::nan(""));
  for (std::size_t k = 1; k < used.size(); ++k) {
    const double before_m = probing.indentation.depth_m[used[k - 1]],
                 after_m = probing.indentation.depth_m[used[k]];
    if (before_m > depth_m || after_m < depth_m || after_m == before_m) continue;
    const double share = (depth_m - before_m) / (after_m - before_m);
    return (1.0 - share) * place(used[k - 1]) + share * place(used[k]);
  }
  const auto [shallowest, deepest] =
      std::minmax_element(used.begin(), used.end(), [&](auto a, auto b) {
        return probing.indentation.depth_m[a] < probing.indentation.depth_m[b];
      });
  return place(depth_m > probing.indentation.depth_m[*deepest] ? *deepest : *shallowest);
}

Vec3 place_of(const RobotLog& log, const AxialProbing& probing, const ContactFit& fit) {
  if (log.contact_m.rows() > 0) {
    const Vec3 named = median_point(log.contact_m, probing.rows);
    if (named.allFinite()) return named;
  }
  if (fit.outcome == ContactOutcome::NoContact) return place_at_depth(log, probing, INFINITY);
  return place_at_depth(log, probing, fit.approach_seen ? fit.contact_depth_m : -INFINITY);
}

double mean_time(const RobotLog& log, const std::vector<Eigen::Index>& rows) {
  std::vector<double> times;
  if (log.time_s.size() == 0) return std::nan("");
  for (const Eigen::Index row : rows)
    if (std::isfinite(log.time_s[row])) times.push_back(log.time_s[row]);
  return median_of(std::move(times));
}

class Reader {
 public:
  Reader(const RobotLog& log, const ContactOptions& options)
      : log_(log),
        options_(options),
        axial_(along_axes(log, probings_in(log))),
        scale_(scale_of(options.model, log.force_unit)) {
    std::vector<double> ranges;
    for (const AxialProbing& probing : axial_.probings)
      ranges.push_back(range_of(probing.indentation.depth_m));
    usual_range_m_ = median_of(ranges);
    require(!(usual_range_m_ > kDeepest_m), "probing_readings",
            "the depth, which spans " + text_of(usual_range_m_) + " m in most probings,",
            "is deeper than tissue: is its unit right?");
    std::vector<Eigen::Index> all(static_cast<std::size_t>(log.size()));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Eigen::Index>(i);
    middle_ = median_point(log.position_m, all);
  }

  ProbedLog read() {
    std::vector<ContactFit> fits = fit_all(options_);
    if (leave_out_limit(fits)) fits = fit_all(options_);
    if (options_.approach == Approach::Find) take_common_approach(fits);
    std::vector<double> values;
    for (const ContactFit& fit : fits)
      if (fit.outcome == ContactOutcome::Fitted) values.push_back(fit.value);
    usual_value_ = median_of(values);
    ProbedLog result;
    result.unit = scale_.unit;
    for (std::size_t i = 0; i < fits.size(); ++i)
      result.probed.push_back(probed_of(axial_.probings[i], fits[i], i));
    add_remarks(fits, result.remarks);
    return result;
  }

 private:
  /// Probings of one log are recorded alike: from the air, or in contact.
  void take_common_approach(std::vector<ContactFit>& fits) const {
    ContactOptions decided = options_;
    decided.approach = Approach::Recorded;
    if (log_.probing.empty()) {  // told apart by contact: each has its approach, if a short one
      fits = fit_all(decided);
      return;
    }
    const auto seen = std::ranges::count(fits, true, &ContactFit::approach_seen);
    const auto fitted = std::ranges::count(fits, ContactOutcome::Fitted, &ContactFit::outcome);
    if (2 * seen <= fitted) decided.approach = Approach::NotRecorded;
    if (seen != fitted && (seen > 0 || decided.approach == Approach::Recorded))
      fits = fit_all(decided);
  }

  /// A force at which two probings or more stay, and which none exceeds, is the sensor's limit:
  /// others that come so far have samples there, too, if too few to be told in one probing.
  bool leave_out_limit(const std::vector<ContactFit>& fits) {
    std::vector<double> held;
    for (const ContactFit& fit : fits)
      if (std::isfinite(fit.held)) held.push_back(fit.held);
    if (held.size() < 2) return false;
    std::nth_element(held.begin(), held.begin() + 1, held.end(), std::greater<>());
    const double limit = held[1];  // of the second, so that there are two
    const double more = limit + kSameForce * std::abs(limit), less = 2.0 * limit - more;
    const auto any = [&](const auto& is) {
      return std::any_of(axial_.probings.begin(), axial_.probings.end(), [&](const auto& probing) {
        return std::any_of(probing.indentation.force.begin(), probing.indentation.force.end(), is);
      });
    };
    if (any([&](double force) { return force > more; })) return false;
    for (AxialProbing& probing : axial_.probings)
      for (double& force : probing.indentation.force)
        if (force >= less) force = std::nan("");
    return true;
  }

  std::vector<ContactFit> fit_all(const ContactOptions& options) const {
    std::vector<ContactFit> fits;
    for (const AxialProbing& probing : axial_.probings)
      fits.push_back(fit_contact(probing.indentation, options));
    return fits;
  }

  Probed probed_of(const AxialProbing& probing, const ContactFit& fit, std::size_t number) const {
    Probed probed;
    const Eigen::Index first = probing.rows.front();
    probed.line = log_.line[static_cast<std::size_t>(first)];
    probed.probing =
        log_.probing.empty()
            ? std::to_string(number + 1)
            : log_.names[static_cast<std::size_t>(log_.probing[static_cast<std::size_t>(first)])];
    if (!log_.session.empty()) probed.session = log_.session[static_cast<std::size_t>(first)];
    probed.time_s = mean_time(log_, probing.rows);
    probed.place_m = place_of(log_, probing, fit);
    probed.normal = probing.outward;
    const bool touched = fit.outcome != ContactOutcome::NoContact;
    probed.contact = !touched ? "none" : fit.approach_seen ? "from the air" : "all in contact";
    probed.reason = reason_of(probing, probed, fit);
    probed.is_missed = !touched && probed.reason == fit.reason;  // where it was is known
    if (!probed.reason.empty()) return probed;
    probed.reading = fit.value * scale_.factor;
    probed.noise_variance = fit.variance * scale_.factor * scale_.factor;
    return probed;
  }

  std::string reason_of(const AxialProbing& probing, const Probed& probed,
                        const ContactFit& fit) const {
    const double range_m = range_of(probing.indentation.depth_m);
    if (range_m > 0.0 &&
        (range_m > kOtherUnit * usual_range_m_ || range_m * kOtherUnit < usual_range_m_))
      return "its depths span " + in_mm(range_m) + ", those of most probings " +
             in_mm(usual_range_m_) + ": it did not move, or is in another unit";
    if (!probed.place_m.allFinite()) return "no position";
    if ((probed.place_m - middle_).norm() > kFarAway_m)
      return "it lies " + text_of(std::round((probed.place_m - middle_).norm() * 10.0) / 10.0) +
             " m away from the middle of all: in another unit?";
    const double share = fit.value / usual_value_;
    if (share > kOtherUnit || share * kOtherUnit < 1.0)
      return "it reads " + text_of(fit.value * scale_.factor) + " " + scale_.unit +
             ", most probings about " + text_of(usual_value_ * scale_.factor) +
             ": in another unit?";
    return fit.reason;
  }

  void add_remarks(const std::vector<ContactFit>& fits, std::vector<std::string>& remarks) const {
    if (log_.probing.empty())
      remarks.push_back("Probings: " + std::to_string(fits.size()) +
                        " found by contact, as no column names them.");
    if (axial_.pressing_is_negative)
      remarks.push_back("The log counts pressing as negative force: its sign was turned.");
    int seen = 0, left_out = 0;
    for (const ContactFit& fit : fits) seen += fit.approach_seen, left_out += fit.left_out;
    remarks.push_back(seen > 0
                          ? "Probings begin in the air: contact points were found with the fit."
                          : "Probings begin in contact: all their samples are used.");
    if (left_out > 0)
      remarks.push_back(std::to_string(left_out) +
                        " samples were left out: not finite, far off their fit, or saturated.");
    add_places(fits, remarks);
  }

  void add_places(const std::vector<ContactFit>& fits, std::vector<std::string>& remarks) const {
    if (log_.contact_m.rows() == 0) return;
    std::vector<double> deeper_m;
    for (std::size_t i = 0; i < fits.size(); ++i) {
      const AxialProbing& probing = axial_.probings[i];
      const Vec3 named = median_point(log_.contact_m, probing.rows);
      const Vec3 begun = place_at_depth(
          log_, probing, fits[i].approach_seen ? fits[i].contact_depth_m : -INFINITY);
      if (named.allFinite() && begun.allFinite())
        deeper_m.push_back(probing.outward.dot(begun - named));
    }
    const double offset_mm = std::round(median_of(deeper_m) * 1e5) / 1e2;
    remarks.push_back("Places: the contact points that the log names, " +
                      text_of(std::abs(offset_mm)) + (offset_mm < 0.0 ? " mm above" : " mm below") +
                      " where the indentations begin, in the median.");
  }

  const RobotLog& log_;
  const ContactOptions& options_;
  AxialLog axial_;
  Scale scale_;
  double usual_range_m_ = 0.0, usual_value_ = 0.0;
  Vec3 middle_ = Vec3::Zero();
};

}  // namespace

ProbedLog probing_readings(const RobotLog& log, const ContactOptions& options) {
  const Eigen::Index n = log.size();
  require(
      n > 0 && log.position_m.rows() == n && (log.force.rows() == n || log.force_along.size() == n),
      "probing_readings", "the log", "must have samples, each with position and force");
  return Reader(log, options).read();
}

}  // namespace palpation
