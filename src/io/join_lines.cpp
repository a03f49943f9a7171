#include "io/join_lines.h"

#include <array>
#include <map>
#include <string>

#include "palpation/base/error.h"

namespace palpation {
namespace {

using Place = std::array<double, 3>;

class Joiner {
 public:
  Joiner(const MeshSource& source, const std::vector<Vec3>& points, const std::vector<Line>& lines)
      : source_(source), points_(points), lines_(lines), used_(lines.size(), false) {
    // The lowest line stands last, and goes first.
    for (std::size_t line = lines.size(); line-- > 0;) {
      if (lines[line].empty()) continue;
      lines_at_[place_of(lines[line].front())].push_back(line);
      lines_at_[place_of(lines[line].back())].push_back(line);
    }
  }

  std::vector<Line> join() {
    std::vector<Line> closed;
    for (std::size_t line = 0; line < lines_.size(); ++line) {
      if (!used_[line] && !lines_[line].empty()) closed.push_back(closed_from(line));
    }
    return closed;
  }

 private:
  /// Adding 0 turns -0 into 0.
  Place place_of(int point) const {
    const Vec3& p = points_[point];
    return {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};
  }

  Line closed_from(std::size_t first) {
    Line path = lines_[first];
    used_[first] = true;
    std::size_t last = first;
    while (place_of(path.back()) != place_of(path.front())) {
      last = next_line(path.back(), last);
      append(lines_[last], path);
    }
    if (path.size() > 1) path.pop_back();
    return path;
  }

  std::size_t next_line(int end, std::size_t last) {
    const Place place = place_of(end);
    std::vector<std::size_t>& here = lines_at_[place];
    while (!here.empty() && used_[here.back()]) here.pop_back();
    if (here.empty()) {
      source_.fail("line " + std::to_string(last) + " ends at (" + text_of(place[0]) + ", " +
                   text_of(place[1]) + ", " + text_of(place[2]) +
                   ") m, and no other goes on there: a boundary is made of closed lines, also "
                   "where it meets the tissue's border");
    }
    used_[here.back()] = true;
    return here.back();
  }

  /// The line goes on from the path's end, whichever of its own ends that is.
  void append(const Line& line, Line& path) const {
    if (place_of(line.front()) == place_of(path.back())) {
      path.insert(path.end(), line.begin() + 1, line.end());
    } else {
      path.insert(path.end(), line.rbegin() + 1, line.rend());
    }
  }

  const MeshSource& source_;
  const std::vector<Vec3>& points_;
  const std::vector<Line>& lines_;
  std::vector<bool> used_;
  std::map<Place, std::vector<std::size_t>> lines_at_;
};

}  // namespace

std::vector<Line> joined_lines(const MeshSource& source, const std::vector<Vec3>& points,
                               const std::vector<Line>& lines) {
  return Joiner(source, points, lines).join();
}

}  // namespace palpation
