/// How much more probable an outline of two heights makes readings than one of one height.
#pragma once

#include <cstdint>
#include <vector>

#include "certainty/outline_start.h"

namespace palpation {

/// A reading in a walk that has settled, on average.
struct SettledReading {
  double on_plateau = 0.0;  ///< how often it lies on a plateau,
  double alike = 0.0;       ///< and how improbable it is that on one beside a core it reads like
                            ///< the others there by chance, nats
};

/// A walk that has settled, on average.
struct SettledOutline {
  /// How probable outlines of its kind are, nats, less what all kinds have in common: by the
  /// readings, the profile, and a core's numbers.
  double log_odds = 0.0;
  double has_plateau = 0.0;  ///< how probable it is that it has one
  double area_m2 = 0.0;      ///< within the outline,
  double area_sd_m2 = 0.0;   ///< and how much that varies
  double level = 0.0;        ///< how often what lies beside the core is as good as level with it,
  double level_beforehand = 1.0;  ///< and how probable that was before any reading
  std::vector<SettledReading> readings{};

  /// There is no second height.
  bool is_level() const { return level > 0.5; }
};
SettledOutline settled(const OutlineStart& start, std::uint64_t seed);

/// How improbable it is that readings beside the core read alike by chance, nats: of those that are
/// on no plateau of an outline of one height, whose edge could have followed any others.
double alike(const SettledOutline& of_one, const SettledOutline& of_two);

/// Within an outline, metres squared: as many of their standard deviations from one as from two
/// heights, where these end farther out; else 0.
double area_between(const SettledOutline& of_one, const SettledOutline& of_two);

enum class Heights { One, OneOrTwo, Two };
Heights heights_by(const SettledOutline& of_one, const SettledOutline& of_two);

/// How probable two heights are where that is open: at most a half.
double probability_of_two(const SettledOutline& of_one, const SettledOutline& of_two);

}  // namespace palpation
