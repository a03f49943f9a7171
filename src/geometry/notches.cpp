#include "geometry/notches.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpation {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kStraight =
    1e-3;  // rad: less of a notch is none, but a border that is not quite straight
constexpr double kLeastNotch = 0.1;  // rad: a notch that has closed, or more than closed

bool is_notch(const Rim& rim) { return rim.interior > kPi + kStraight; }
double opening(const Rim& rim) { return std::max(2.0 * kPi - rim.interior, kLeastNotch); }

double chord_at(const BorderLoop& loop, std::size_t i) {
  const double a = loop[before(loop, i)].length, b = loop[i].length;
  const double half = std::sin(0.5 * opening(loop[i]));
  return std::sqrt((a - b) * (a - b) + 4.0 * a * b * half * half);
}

double turning_of(const BorderLoop& loop) {
  double turning = 0.0;
  for (const Rim& rim : loop) turning += kPi - rim.interior;
  return turning;
}

/// The notch at i becomes a flat triangle, and its chord part of the border.
void fill(BorderLoop& loop, std::size_t i, double target, MetricBuilder& builder) {
  const std::size_t last = before(loop, i), next = after(loop, i);
  const double chord = std::max(loop[i].chord, 1e-6 * std::max(loop[last].length, loop[i].length));
  const int face = builder.add_face({loop[next].vertex, loop[i].vertex, loop[last].vertex},
                                    {loop[i].length, loop[last].length, chord}, target);
  builder.glue(3 * face, loop[i].half_edge);
  builder.glue(3 * face + 1, loop[last].half_edge);
  loop[next].interior += builder.angle(face, 0);
  loop[last].interior += builder.angle(face, 2);
  loop[last].half_edge = 3 * face + 2;
  loop[last].length = chord;
  loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
}

/// Three edges around what was a hole.
void close(BorderLoop& loop, double target, MetricBuilder& builder) {
  const int face = builder.add_face({loop[1].vertex, loop[0].vertex, loop[2].vertex},
                                    {loop[0].length, loop[2].length, loop[1].length}, target);
  builder.glue(3 * face, loop[0].half_edge);
  builder.glue(3 * face + 1, loop[2].half_edge);
  builder.glue(3 * face + 2, loop[1].half_edge);
  loop.clear();
}

}  // namespace

void fill_notches(BorderLoop& loop, double widest, double target, MetricBuilder& builder) {
  for (std::size_t i = 0; i < loop.size(); ++i) loop[i].chord = chord_at(loop, i);
  while (loop.size() > 3) {
    std::size_t narrowest = loop.size();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (is_notch(loop[i]) && loop[i].chord <= widest &&
          (narrowest == loop.size() || loop[i].chord < loop[narrowest].chord))
        narrowest = i;
    }
    if (narrowest == loop.size()) return;
    fill(loop, narrowest, target, builder);
    const std::size_t next = narrowest == loop.size() ? 0 : narrowest, last = before(loop, next);
    loop[last].chord = chord_at(loop, last);
    loop[next].chord = chord_at(loop, next);
  }
  if (turning_of(loop) < -kPi) close(loop, target, builder);
}

}  // namespace palpation
