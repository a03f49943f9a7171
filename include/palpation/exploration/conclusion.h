/// All that was inferred from the readings so far: a value.
///
///     const Conclusion conclusion = conclude(tissue, model, readings);
///
/// The field by the readings (Garg et al. 2016, equations 1 and 2), whether it shows more than
/// noise, the level at the tumour's edge (equation 4), the boundary and how sure it is.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "palpation/belief/belief.h"
#include "palpation/belief/lag.h"
#include "palpation/belief/level.h"
#include "palpation/certainty/certainty.h"
#include "palpation/certainty/edge_belief.h"
#include "palpation/certainty/outline_posterior.h"
#include "palpation/exploration/model.h"
#include "palpation/readings/reading_scale.h"

namespace palpation {

/// The boundary is where the field, one value per vertex, reaches the level.
struct Contour {
  Field field;
  double level = 0.0;
  /// A boundary was felt, but it is nowhere wider than the probe's tip: what is left of it once the
  /// tip is taken back is nothing.
  bool tip_hides_all = false;
};

/// A part that stands out by less than the model's least contrast (Contrast::least).
struct WeakerPart {
  SurfacePoint where;     ///< its highest place
  double contrast = 0.0;  ///< there, above healthy tissue, in readings
};

/// What stands out beside a tumour by too little to be one surely (Misfit, MisfitKind::WeakerPart);
/// or a part of what was found, along so much of the border that another tissue would look alike.
struct DoubtfulPart {
  SurfacePoint where;         ///< its highest place, or its surest off the border
  double area_m2 = 0.0;       ///< where the field stands out half as high, or more; or its own
  double border_share = 0.0;  ///< of the border's length, what such a part takes

  bool is_along_border() const { return border_share > 0.0; }
};

/// Whether the readings tell of a tumour at all.
struct Evidence {
  bool contrast_seen = false;
  ReadingScale scale = ReadingScale::Raw;  ///< on which the readings are modelled
  /// Where readings do not tell whether they are even about an edge or their logarithms are: the
  /// area within the outline by logarithms. The one drawn is of readings as they are; the band
  /// holds both.
  std::optional<double> area_by_logarithms_m2{};
  /// By how much an edge makes the readings more probable than healthy tissue alone that waves, or
  /// errors that last from reading to reading, whichever explains the most; asked at the end, of
  /// waves (EdgeBelief::odds_over_waves) where a smooth field explains the readings as well or some
  /// were made on the way, kept of errors (in_lasting_errors) where they may be all. Before the
  /// end: than level tissue, kept where that may be all. Where an edge is clearly less probable
  /// than level tissue, errors, or waves that are slower than a tumour is wide, there is no level:
  /// no tumour was felt.
  std::optional<EdgeOdds> of_edge{};
  /// Errors that last beside the edge, clearly; asked at the end. The outlines know of them.
  LastingErrors errors_beside_edge{};
  bool trend_is_missing = false;  ///< a trend is modelled, but too few places are touched yet to
                                  ///< tell a tumour from a tilt
  /// Readings that lie farther from all others than those from each other (readings_apart), the
  /// trend apart, and none of them beside another: what they alone show is no contrast, and where
  /// the others show some and these lie ten times as far out, they are set aside (kStandsAlone).
  std::vector<Palpation> standing_alone{};
  /// What was taken out of the boundary as too weak for a tumour.
  std::vector<WeakerPart> weaker{};
  /// What is as likely tumour as not: it lies in the band, and a half of it counts as expected to
  /// be wrong. What lies along the border is cut out, the rest is not.
  std::vector<DoubtfulPart> doubtful{};
  /// Slope, waves, drift, zeros, gains and moves of the tissue, in the order in which they were
  /// found: each is of readings without those before it. Numbers are those of
  /// Conclusion::palpations.
  std::vector<Misfit> taken_back{};
  /// A step in readings that were made on other ground since then, which tissue may have made, or
  /// the zero: it is taken for tissue.
  std::optional<Misfit> zero_or_tissue{};
  /// Readings that have an outline of their own since some moment, where that was asked for: the
  /// boundary is of both.
  std::optional<Misfit> another_outline{};

  /// Whether level and boundary may be concluded.
  bool allows_boundary() const { return contrast_seen && !trend_is_missing; }
};

struct Conclusion {
  Model model;  ///< that it was concluded under
  /// The readings as they were made, with the reason where one is set aside.
  std::vector<Palpation> palpations;
  /// Knows the same readings, without what changes did that are taken back, where a lag is modelled
  /// at the places where they belong, and those on the way that are next to each other as one.
  Belief belief;
  /// The whole field: its variance is what touches are planned by.
  Marginals marginals;
  /// What level and boundary are of: the mean without the slope, and without what a round tip feels
  /// early, with the variance of the whole field; equal to `marginals` where neither is modelled.
  /// The variance without the slope would count as unsure what level and slope trade between them:
  /// it overstates the error.
  Marginals component;
  Evidence evidence;
  /// Nothing where none is modelled, or it is to be learned and no reading tells.
  std::optional<Lag> lag;
  /// As it is estimated; nothing before the readings show contrast, nor while they are all alike,
  /// unless it is known: the range of noise is no level.
  std::optional<Level> level;
  /// What is known of the boundary in depths; nothing unless the level is inferred from its edge,
  /// and one is seen.
  std::optional<EdgeBelief> edge;
  /// The outlines that were drawn, where that was asked for and there is an edge, and a chart that
  /// they lie in; then level, contour and certainty are of them.
  std::optional<OutlinePosterior> outlines;
  /// The boundary: of the depth where `outlines` or `edge` know it, of the component else; what a
  /// round tip feels early is taken back. Nothing where there is no level.
  std::optional<Contour> contour;
  /// How sure the boundary is; nothing where there is no level or no reading, or the model has no
  /// band.
  std::optional<Certainty> certainty;

  bool tip_hides_all() const { return contour && contour->tip_hides_all; }
  /// That the field is modelled on: belief, marginals, component, level, edge and contour are in
  /// its units, so that with ReadingScale::Log exp of a mean is a reading (its median).
  ReadingScale scale() const { return evidence.scale; }
};

/// The readings, without what changed while they were made (Evidence::taken_back), in the belief's
/// units.
std::vector<Palpation> readings_as_if_unchanged(const Conclusion& conclusion);

/// How a session differs from the one before it.
struct SessionChange {
  Misfit zero;
  std::optional<DrawnNumber> gain;  ///< what stands out does so as many times as much; where
                                    ///< outlines were drawn
};
/// Of each but the first that is taken to have a zero of its own. With outlines these tell both;
/// else the field tells the zero, and is too sure of it where it was learned from one plateau.
std::vector<SessionChange> session_changes(const Conclusion& conclusion);

/// What else was taken back, in time.
std::vector<Misfit> other_changes(const Conclusion& conclusion);

/// The level in the readings' own unit, its standard deviation to first order.
std::optional<Level> level_in_readings(const Conclusion& conclusion);

/// What the readings say that the conclusion does not (misfit.h), the strongest first; of the field
/// that they moved with the tissue, where that explains more than a zero or a gain (changed_since).
/// Of changes of zero, gain and place one can pass for another: only the strongest is among them.
/// Takes a tenth of a second.
std::vector<Misfit> misfits(const Conclusion& conclusion);

/// exploration/background_search.h
struct TriedBackgrounds;

/// Beliefs that were made on the way to a conclusion, for the next one to grow by its fresh
/// readings alone, and what was tried, for another conclusion from the same ones. It changes
/// nothing but the time: what is concluded with it is what is concluded without, to the bit. Copies
/// share.
class ConclusionCache {
 public:
  /// The belief of this prior and these options that knows the palpations. Grows batch by batch, by
  /// their numbers: so it is the same however much of it was known before.
  Belief grown(const Belief& blank, std::span<const Palpation> palpations);
  /// Does the work for touches at these places that no reading changes (Belief::foresee).
  void foresee(std::span<const SurfacePoint> places);

  /// What was tried on such readings; nothing where it is not remembered.
  std::shared_ptr<const TriedBackgrounds> tried(const Surface& surface, const Model& model,
                                                std::span<const Palpation> felt) const;
  /// The four last are remembered: readings have two scales, and may have a soft spot.
  void remember(std::shared_ptr<const TriedBackgrounds> tried);
  void remember_tried_by(const ConclusionCache& other) { tried_ = other.tried_; }

 private:
  std::shared_ptr<const Belief> last_;
  std::vector<std::shared_ptr<const TriedBackgrounds>> tried_;  // the latest first
};

/// Where nothing is felt yet, the prior's; a given level is known even then. Depends on the
/// arguments alone; readings that could not be made (TouchKind::Missed) tell nothing. Reasons why
/// readings are set aside that are this function's own are judged anew. With a seed all is known
/// that will be: a gain that changed and tissue that moved are taken back (Evidence::taken_back),
/// and the boundary's outlines are drawn (outline_posterior.h), which takes seconds and is honest
/// about corners, horns and necks; else Laplace's approximation tells how sure it is. Throws
/// InvalidInput as check(Model), Prior and BeliefOptions say, NumericalError where no field can be
/// fitted.
Conclusion conclude(const Surface& surface, const Model& model, std::span<const Palpation> readings,
                    ConclusionCache* cache = nullptr,
                    std::optional<std::uint64_t> sampling_seed = std::nullopt);

}  // namespace palpation
