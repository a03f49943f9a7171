#include "palpation/decision/tour.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr int kMostExactStops = 12;

/// Rounding must not look like a gain, or two equal tours would be exchanged for ever.
constexpr double kLeastGain = 1e-12;  // of the longest distance

/// Places of the matrix in the order of travel; path[0] is the probe's, row 0.
using Path = std::vector<int>;

void check(const Eigen::MatrixXd& distance) {
  const std::string size =
      std::to_string(distance.rows()) + " x " + std::to_string(distance.cols()) + " distances";
  require(distance.rows() == distance.cols() && distance.rows() > 0, "shortest_tour", size,
          "must be square and hold the probe's row");
  for (Eigen::Index i = 0; i < distance.rows(); ++i) {
    for (Eigen::Index j = 0; j < distance.cols(); ++j) {
      const double d = distance(i, j);
      if (d >= 0.0 && d <= std::numeric_limits<double>::max()) continue;
      const std::string value =
          "distance(" + std::to_string(i) + ", " + std::to_string(j) + ") = " + text_of(d);
      require(false, "shortest_tour", value, "must be finite and not negative");
    }
  }
  const double tolerance = 1e-9 * distance.maxCoeff();
  require((distance - distance.transpose()).cwiseAbs().maxCoeff() <= tolerance, "shortest_tour",
          size, "must be symmetric");
}

/// Held and Karp's recursion, from the end: C(S, j) = min over k not in S of d(j, k) + C(S + k, k),
/// the least way through all stops that are not yet in S.
class HeldKarp {
 public:
  explicit HeldKarp(const Eigen::MatrixXd& distance)
      : distance_(distance),
        stops_(static_cast<int>(distance.rows()) - 1),
        rest_(Eigen::MatrixXd::Zero(stops_, Eigen::Index{1} << stops_)) {
    for (int visited = all() - 1; visited > 0; --visited) {
      for (int last = 0; last < stops_; ++last) {
        if (contains(visited, last))
          rest_(last, visited) = length_by(visited, last + 1, next_stop(visited, last + 1));
      }
    }
  }

  std::vector<int> order() const {
    std::vector<int> stops;
    int place = 0;
    for (int visited = 0; visited != all();) {
      const int stop = next_stop(visited, place);
      stops.push_back(stop);
      visited |= 1 << stop;
      place = stop + 1;
    }
    return stops;
  }

 private:
  int all() const { return (1 << stops_) - 1; }
  static bool contains(int set, int stop) { return (set >> stop & 1) != 0; }
  double length_by(int visited, int place, int stop) const {
    return distance_(place, stop + 1) + rest_(stop, visited | 1 << stop);
  }

  /// The lowest of the best.
  int next_stop(int visited, int place) const {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int stop = 0; stop < stops_; ++stop) {
      if (contains(visited, stop)) continue;
      const double length = length_by(visited, place, stop);
      if (length < least) {
        least = length;
        best = stop;
      }
    }
    return best;
  }

  const Eigen::MatrixXd& distance_;
  int stops_;
  Eigen::MatrixXd rest_;  // last stop x set of visited stops
};

Path nearest_neighbour(const Eigen::MatrixXd& distance) {
  Path path(distance.rows());
  std::iota(path.begin(), path.end(), 0);
  for (auto next = path.begin() + 1; next != path.end(); ++next) {
    const int here = *(next - 1);
    // The rest is kept in increasing order, so the first of equals is the lowest.
    const auto nearest = std::min_element(
        next, path.end(), [&](int a, int b) { return distance(here, a) < distance(here, b); });
    std::rotate(next, nearest, nearest + 1);
  }
  return path;
}

/// Shortens an open path until no reversal of a stretch (2-opt) and no move of up to three
/// neighbours elsewhere (Or-opt) helps.
class LocalSearch {
 public:
  LocalSearch(const Eigen::MatrixXd& distance, Path path)
      : distance_(distance),
        path_(std::move(path)),
        last_(static_cast<int>(path_.size()) - 1),
        least_gain_(kLeastGain * distance.maxCoeff()) {}

  Path improved() {
    while (reverse_stretches() || move_stretches()) {
    }
    return path_;
  }

 private:
  /// Length of the way between two neighbours; behind the end of an open path there is none.
  double way(int from_position, int to_position) const {
    return to_position > last_ ? 0.0 : distance_(path_[from_position], path_[to_position]);
  }

  bool reverse_stretches() {
    bool helped = false;
    for (int first = 1; first < last_; ++first) {
      for (int end = first + 1; end <= last_; ++end) {
        const double before = way(first - 1, first) + way(end, end + 1);
        const double after = way(first - 1, end) + way(first, end + 1);
        if (!(before - after > least_gain_)) continue;
        std::reverse(path_.begin() + first, path_.begin() + end + 1);
        helped = true;
      }
    }
    return helped;
  }

  bool move_stretches() {
    bool helped = false;
    for (int length = 1; length <= 3; ++length) {
      for (int first = 1; first + length - 1 <= last_; ++first)
        helped |= move_stretch(first, first + length - 1);
    }
    return helped;
  }

  /// Puts the stretch first..end behind the first position, in the first orientation, that makes
  /// the path shorter.
  bool move_stretch(int first, int end) {
    const double gap_closed = way(first - 1, first) + way(end, end + 1) - way(first - 1, end + 1);
    for (int behind = 0; behind <= last_; ++behind) {
      if (behind >= first - 1 && behind <= end) continue;
      for (const bool reversed : {false, true}) {
        const int head = reversed ? end : first, tail = reversed ? first : end;
        const double gap_opened =
            way(behind, head) + way(tail, behind + 1) - way(behind, behind + 1);
        if (!(gap_closed - gap_opened > least_gain_)) continue;
        if (reversed) std::reverse(path_.begin() + first, path_.begin() + end + 1);
        if (behind < first) {
          std::rotate(path_.begin() + behind + 1, path_.begin() + first, path_.begin() + end + 1);
        } else {
          std::rotate(path_.begin() + first, path_.begin() + end + 1, path_.begin() + behind + 1);
        }
        return true;
      }
    }
    return false;
  }

  const Eigen::MatrixXd& distance_;
  Path path_;
  int last_;
  double least_gain_;
};

std::vector<int> stops_of(const Path& path) {
  std::vector<int> stops;
  for (std::size_t position = 1; position < path.size(); ++position)
    stops.push_back(path[position] - 1);
  return stops;
}

}  // namespace

std::vector<int> shortest_tour(const Eigen::MatrixXd& distance) {
  check(distance);
  const Eigen::MatrixXd symmetric = 0.5 * distance + 0.5 * distance.transpose();
  if (distance.rows() - 1 <= kMostExactStops) return HeldKarp(symmetric).order();
  return stops_of(LocalSearch(symmetric, nearest_neighbour(symmetric)).improved());
}

double tour_length(const Eigen::MatrixXd& distance, const std::vector<int>& order) {
  double length = 0.0;
  int place = 0;
  for (int stop : order) {
    require(stop >= 0 && stop + 1 < distance.rows() && stop + 1 < distance.cols(), "tour_length",
            "stop " + std::to_string(stop), "has no row in the distances");
    length += distance(place, stop + 1);
    place = stop + 1;
  }
  return length;
}

}  // namespace palpation
