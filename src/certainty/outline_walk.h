/// One chain through the outlines' posterior: what is proposed, and how far.
///
/// A sweep tries each node, stretches of nodes of several widths, a polygon's sides and corners,
/// and each loop as a whole (moved, grown, turned, bent), all of them with the slope whatever the
/// plateaus, the profile, and cuts.
/// Steps find their own lengths while the walk settles, and keep them from then on, so that what is
/// kept is of the posterior.
#pragma once

#include <array>
#include <vector>

#include "certainty/outline_chain.h"

namespace palpation {

Vec2 direction_of(Random& random);

struct OutlineDraw {
  OutlineNodes outline;
  OutlineProfile profile;
  ReadingLaw law;  ///< of the profile
  /// A tumour has a plateau, and its boundary, the outline, at the fraction of that; or, as likely
  /// as its bends are there (plateau_probability), none: then it is as high as it is where it is
  /// deepest, and its boundary at the fraction of that height.
  bool has_plateau = true;
  std::vector<Stadium> cuts;
  Eigen::VectorXd steps;              ///< of the zero, of the changes that move it
  double log_noise = 0.0;             ///< of what the noise's standard deviations are multiplied by
  double noise_growth = 0.0;          ///< logarithm: the noise on a tumour over that beside it
  std::vector<std::size_t> unheeded;  ///< readings that tell nothing
};

class OutlineWalk {
 public:
  /// As OutlineChain has it.
  OutlineWalk(const OutlineReadings& readings, const OutlinePrior& prior, OutlineNodes start,
              OutlineProfile profile, std::uint64_t seed);

  /// Sweeps while the steps' lengths are found. In the first of them, `telling` so many, lines stay
  /// of the kind that they begin as, and so does which readings tell: noise falls faster than an
  /// outline follows sharp readings to a corner, and those there would be told as nothing before it
  /// came. Not where loops are weighed: one that is noise would settle about the reading that it is
  /// of.
  void settle(int sweeps, int telling = 0);
  /// Further sweeps, of which so many outlines are kept, evenly.
  std::vector<OutlineDraw> draws(int sweeps, int count);

  const OutlineChain& chain() const { return chain_; }

 private:
  /// Share of steps that are taken where they are as long as they should be, of single numbers and
  /// of nodes.
  static constexpr double kOfNumbers = 0.4, kOfNodes = 0.3;
  /// How long steps are at first, and at most.
  static constexpr double kFirst_m = 0.0003, kMost_m = 0.008;
  static constexpr int kWidths = 4, kWhole = 6, kOfProfile = 9, kOfCut = 4, kOfCore = 6;
  struct Lengths {
    std::vector<std::array<double, kWidths>> of_stretches;  ///< by node, metres
    std::vector<std::array<double, kWhole>> of_loops;       ///< metres
    std::vector<double> of_contrasts;
    std::vector<double> of_changes;
    std::vector<double> of_moves;  ///< with nodes, metres
    std::array<double, kOfProfile> of_profile;
    std::array<double, kOfCut> of_cuts;
    std::array<double, kOfCore> of_core;
    std::array<std::vector<double>, 2> of_ways;        ///< by reading; that last, by term; of one
    double of_size = 0.03;                             ///< logarithm
    std::array<double, 2> of_way_scales = {0.1, 0.1};  ///< logarithm
    double of_wandering_with_nodes = kFirst_m;
  };

  void sweep();
  OutlineDraw drawn();
  void move_stretch(int middle, int width);
  void move_loop(int loop, int kind);
  void move_sides();
  void move_corner(int node);
  void pass_corner(int node);
  void cut_or_point(int node);
  void move_size();
  void move_profile();
  void switch_line_kind();
  void move_core();
  void move_changes();
  void move_with_nodes(std::size_t change);
  void wander();
  void scale_ways();
  void wander_with_nodes();
  void trade_gain(std::size_t change);
  void move_cuts();
  void tune(double& length, bool taken, double share, double most) const;

  OutlineChain chain_;
  Random random_;
  Lengths lengths_;
  std::vector<std::vector<double>> felt_since_;  // by change and node, a share
  Eigen::VectorXd same_way_;  // terms by which all ways that last are alike, over their scale
  Eigen::VectorXd steps_;     // of the zero, as last drawn
  bool settling_ = false;
  bool keeps_telling_ = false;  // readings that tell, and the kind of lines
  int swept_ = 0;
};

}  // namespace palpation
