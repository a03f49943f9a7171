#include "palpation/probing/oscillation.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "palpation/base/error.h"
#include "probing/demodulation.h"
#include "probing/log_samples.h"
#include "probing/robust.h"

namespace palpation {
namespace {

constexpr double kGapPeriods = 0.5;
constexpr double kGapSteps = 5.5;
constexpr double kLostContact = 0.2;      // the force's harmonics, of the first
constexpr double kClear = 4.0;            // standard deviations of an amplitude
constexpr double kNanosPerPeriod = 1e-6;  // of a period: rounding of stamps

/// The samples of one window: time from its middle, and columns of force and position.
struct Window {
  Eigen::Index first = 0, last = 0;
  Eigen::VectorXd time_s{};
  Eigen::MatrixXd force{}, position_m{};
};

Eigen::MatrixXd force_columns(const RobotLog& log) {
  return log.force.rows() > 0 ? Eigen::MatrixXd(log.force) : Eigen::MatrixXd(log.force_along);
}

/// The real direction in which a complex amplitude moves most.
Vec3 main_direction(const Eigen::RowVector3cd& amplitude) {
  const Eigen::Matrix3d moved = (amplitude.adjoint() * amplitude).real();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moved).eigenvectors().col(2);
}

/// The mean of the log's normals in a window; zero where there is none.
Vec3 mean_normal(const RobotLog& log, const Window& window) {
  Vec3 sum = Vec3::Zero();
  if (log.normal.rows() == 0) return sum;
  for (Eigen::Index i = window.first; i <= window.last; ++i) {
    const Vec3 normal = log.normal.row(i);
    if (normal.allFinite() && normal.norm() > 0.0) sum += normal.normalized();
  }
  return sum.norm() > 0.0 ? Vec3(sum.normalized()) : sum;
}

/// One component of motion and force, their line of action chosen.
struct Along {
  Vec3 axis = Vec3::Zero();
  double mean_force = 0.0;
  Eigen::VectorXcd force, position_m;  // by harmonic
  Eigen::VectorXd force_left, position_left;
};

Along along_axis(const RobotLog& log, const Window& window, const Demodulated& force,
                 const Demodulated& position, const Vec3& reference) {
  Along along;
  const bool is_vector = force.amplitudes.cols() == 3;
  along.axis = mean_normal(log, window);
  if (along.axis.isZero(0.0)) {
    along.axis = main_direction(is_vector ? Eigen::RowVector3cd(force.amplitudes.row(0))
                                          : Eigen::RowVector3cd(position.amplitudes.row(0)));
    // Neighbours agree on which way is up, by the force or by one direction for all.
    const Vec3 up = is_vector ? Vec3(window.force.colwise().mean()) : reference;
    if (up.dot(along.axis) < 0.0) along.axis = -along.axis;
  }
  along.mean_force =
      is_vector ? window.force.colwise().mean().dot(along.axis) : window.force.col(0).mean();
  along.position_m = position.amplitudes * along.axis;
  along.position_left = position.left * along.axis;
  along.force = is_vector ? Eigen::VectorXcd(force.amplitudes * along.axis)
                          : Eigen::VectorXcd(force.amplitudes.col(0));
  along.force_left =
      is_vector ? Eigen::VectorXd(force.left * along.axis) : Eigen::VectorXd(force.left.col(0));
  return along;
}

/// The direction of travel: from the mean of the first third to that of the last.
Vec3 travel_of(const Window& window) {
  const Eigen::Index third = std::max<Eigen::Index>(1, window.position_m.rows() / 3);
  const Vec3 step = window.position_m.bottomRows(third).colwise().mean() -
                    window.position_m.topRows(third).colwise().mean();
  return step.norm() > 0.0 ? Vec3(step.normalized()) : Vec3(Vec3::Zero());
}

class Slide {
 public:
  Slide(const RobotLog& log, const OscillationOptions& options, double frequency_hz)
      : log_(log), options_(options), frequency_hz_(frequency_hz), forces_(force_columns(log)) {}

  /// A window's result; the reading has the sign of force over position along the axis.
  Probed read(const Window& window) {
    Probed probed = start(window);
    const Eigen::Index n = window.time_s.size();
    if (n < kDrift + 2 * kHarmonics + 4 || n < 6 * options_.window_periods)
      return failed(probed, "too few samples: " + std::to_string(n) + " in " +
                                std::to_string(options_.window_periods) + " periods");
    if ((window.force.rowwise() - window.force.row(0)).isZero(0.0))
      return failed(probed, "the force is stuck");
    const double half_s = 0.5 * options_.window_periods / frequency_hz_;
    const Eigen::MatrixXd basis = basis_of(window.time_s, frequency_hz_, half_s);
    const Eigen::HouseholderQR<Eigen::MatrixXd> solver(basis);
    const Along along = along_axis(log_, window, demodulate(solver, basis, window.force),
                                   demodulate(solver, basis, window.position_m), reference_);
    reference_ = along.axis;
    return judge(probed, along,
                 Beside(window.time_s, solver, basis, frequency_hz_, options_.window_periods));
  }

  std::vector<Window> windows() const {
    std::vector<Window> windows;
    const double step_s = options_.step_periods / frequency_hz_;
    const double length_s = options_.window_periods / frequency_hz_;
    const double gap_s = std::max(kGapPeriods / frequency_hz_, kGapSteps * usual_step_s(log_));
    for (const Stretch& stretch : stretches_in_time(log_, gap_s)) {
      const double end_s = log_.time_s[stretch.last] + kNanosPerPeriod / frequency_hz_;
      Eigen::Index first = stretch.first;
      for (int k = 0;; ++k) {
        const double start_s = log_.time_s[stretch.first] + k * step_s;
        if (start_s + length_s > end_s + usual_step_s(log_)) break;
        while (log_.time_s[first] < start_s) ++first;
        windows.push_back(window_from(first, stretch.last, start_s, length_s));
      }
    }
    return windows;
  }

 private:
  Window window_from(Eigen::Index first, Eigen::Index most, double start_s, double length_s) const {
    Window window{.first = first, .last = first};
    while (window.last < most && log_.time_s[window.last + 1] < start_s + length_s) ++window.last;
    const Eigen::Index n = window.last - first + 1;
    window.time_s = log_.time_s.segment(first, n).array() - (start_s + 0.5 * length_s);
    window.force = forces_.middleRows(first, n);
    window.position_m = log_.position_m.middleRows(first, n);
    return window;
  }

  Probed start(const Window& window) const {
    Probed probed;
    probed.place_m = window.position_m.colwise().mean();
    probed.time_s = log_.time_s.segment(window.first, window.time_s.size()).mean();
    probed.travel = travel_of(window);
    probed.contact = "sliding";
    probed.line = log_.line[static_cast<std::size_t>(window.first)];
    if (!log_.session.empty())
      probed.session = log_.session[static_cast<std::size_t>(window.first)];
    return probed;
  }

  static Probed failed(Probed probed, const std::string& reason) {
    probed.reason = reason;
    return probed;
  }

  Probed judge(Probed probed, const Along& along, const Beside& beside) const {
    const Complex f = along.force[0], x = along.position_m[0];
    const Complex ratio = std::norm(x) > 0.0 ? f / x : Complex(0.0);
    const double error = beside.error(along.force_left, along.position_left, ratio);
    const double of_force = beside.error(along.force_left, along.position_left, Complex(0.0));
    if (!(std::norm(x) > 0.0) || !(std::norm(f) > kClear * kClear * of_force))
      return failed(probed, "no oscillation of the force stands out of its noise: no contact?");
    const Eigen::VectorXcd bent = along.force - ratio * along.position_m;  // no spring's harmonics
    if (bent.tail(kHarmonics - 1).norm() > kLostContact * std::abs(f))
      return failed(probed, "contact is lost in part of the cycle");
    probed.reading = (f * std::conj(x)).real() / std::norm(x) * 1e-3;
    // Pressing deeper presses harder: outward is where force and motion go against each other.
    probed.normal = probed.reading * along.mean_force > 0.0 ? Vec3(-along.axis) : along.axis;
    const int degrees = 4 * (options_.window_periods / 2);
    const double overlap = std::max(1.0, double(options_.window_periods) / options_.step_periods);
    probed.noise_variance =
        overlap * student_variance(degrees * error, degrees) / 2.0 / std::norm(x) * 1e-6;
    return probed;
  }

  const RobotLog& log_;
  const OscillationOptions& options_;
  double frequency_hz_;
  Eigen::MatrixXd forces_;
  Vec3 reference_ = Vec3::UnitZ();
};

double frequency_of(const RobotLog& log, const OscillationOptions& options) {
  if (options.frequency_hz > 0.0) return options.frequency_hz;
  const std::vector<double> found = oscillations_in(log);
  std::string names;
  for (const double hz : found)
    names += (names.empty() ? "" : ", ") + text_of(std::round(hz * 1e3) / 1e3);
  require(!found.empty(), "slide_readings", "the log",
          "shows no oscillation that stands out of force and position: name its frequency");
  require(found.size() == 1, "slide_readings", "the log",
          "shows more than one oscillation (" + names + " Hz): name the one that is meant");
  return found.front();
}

/// Force and position oscillate against each other or together, by how a robot counts its force:
/// most windows say which.
void take_common_sign(std::vector<Probed>& probed) {
  double sum = 0.0;
  for (const Probed& one : probed)
    if (one.reason.empty()) sum += std::copysign(1.0, one.reading);
  const double sign = sum < 0.0 ? -1.0 : 1.0;
  for (Probed& one : probed) {
    if (!one.reason.empty()) continue;
    one.reading *= sign;
    if (one.reading > 0.0) continue;
    one.reason = "force and position oscillate the other way round than elsewhere";
    one.reading = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

ProbedLog slide_readings(const RobotLog& recorded, const OscillationOptions& options) {
  const RobotLog log = finite_samples(recorded);
  const Eigen::Index n = log.size();
  require(n > 0 && log.time_s.size() == n && log.position_m.rows() == n &&
              (log.force.rows() == n || log.force_along.size() == n),
          "slide_readings", "the log", "must have samples, each with time, position and force");
  require(options.window_periods >= 4 && options.step_periods >= 1, "slide_readings",
          std::to_string(options.window_periods) + " periods a window, one each " +
              std::to_string(options.step_periods),
          "must be at least 4, and at least 1");
  require(std::isfinite(options.frequency_hz) && options.frequency_hz >= 0.0, "slide_readings",
          "frequency " + text_of(options.frequency_hz), "must be positive, or 0: found");
  const double frequency_hz = frequency_of(log, options);
  require(frequency_hz * 6.0 * usual_step_s(log) <= 1.0, "slide_readings",
          "frequency " + text_of(frequency_hz) + " Hz",
          "needs six samples a period: the log has one each " +
              text_of(std::round(usual_step_s(log) * 1e4) / 10.0) + " ms");

  Slide slide(log, options, frequency_hz);
  ProbedLog result;
  for (const Window& window : slide.windows()) {
    result.probed.push_back(slide.read(window));
    result.probed.back().probing = "window " + std::to_string(result.probed.size());
  }
  take_common_sign(result.probed);
  if (n < recorded.size())
    result.remarks.push_back(std::to_string(recorded.size() - n) +
                             " samples were left out: not finite.");
  result.unit = log.force_unit + "/mm";
  result.remarks.push_back("Oscillation: " + text_of(std::round(frequency_hz * 1e3) / 1e3) + " Hz" +
                           (options.frequency_hz > 0.0 ? ", as given" : ", found in the log") +
                           "; windows of " + std::to_string(options.window_periods) + " periods.");
  return result;
}

}  // namespace palpation
