#include "scene/area_remarks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "palpation/boundary/level_set.h"
#include "scene/reachable.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

constexpr double kMuchStiff = 0.5;  // of the tissue
/// Expected wrong area beyond this part of the area found is told: the boundary is then hardly
/// better than a guess.
constexpr double kLargeShare = 0.25, kSmallShare = 0.1;
constexpr double kMuchCutOff = 0.5;         // of what is expected to be wrong
constexpr double kCrossing = 0.5;           // of a triangle's edge, that a line through it is long
constexpr double kMuchOverReachable = 5.0;  // times what readings can reach: that is worth a word

/// Where the boundary is the least known: the farthest from it of all places that it may reach, a
/// standard deviation off at most.
std::string least_known_words(const Conclusion& conclusion) {
  if (!conclusion.outlines) return "";
  const Field far = conclusion.outlines->depth.cwiseAbs();
  const Field off = (far.array() <= conclusion.outlines->spread.array()).select(far, 0.0);
  Eigen::Index vertex = 0;
  if (off.maxCoeff(&vertex) == 0.0) return "";
  const Surface& surface = conclusion.belief.prior().surface();
  return ", above all around " + place_words(surface.vertex(static_cast<int>(vertex)), 1);
}

/// Lines on triangles cut off what the outline bulges: of an arc of radius r over an edge of length
/// L, L^2 / (12 r) on average. `parts`: of equal size.
std::string coarse_words(const Surface& surface, const Certainty& certainty, double found_m2,
                         std::size_t parts) {
  const double radius_m = std::sqrt(found_m2 / (std::numbers::pi * static_cast<double>(parts)));
  double cut_off_m2 = 0.0, widest_m = 0.0;
  for (int face = 0; face < surface.face_count(); ++face) {
    const Eigen::Vector3i corners = surface.triangle(face);
    const Eigen::Vector3d score = certainty.score(corners);
    if (score.minCoeff() >= 0.0 || score.maxCoeff() < 0.0) continue;
    double edges_m = 0.0;
    for (int i = 0; i < 3; ++i)
      edges_m += (surface.vertex(corners[i]) - surface.vertex(corners[(i + 1) % 3])).norm() / 3.0;
    widest_m = std::max(widest_m, edges_m);
    cut_off_m2 += kCrossing * edges_m * edges_m * edges_m / (12.0 * radius_m);
  }
  if (cut_off_m2 < kMuchCutOff * certainty.expected.symmetric_difference_m2()) return "";
  return "The mesh is coarse where the outline runs, with triangles up to " +
         fixed(widest_m * 1e3, 1) + " mm wide: they cut some " +
         fixed(cut_off_m2 * 1e6, cut_off_m2 < 1e-6 ? 1 : 0) +
         " mm2 off what is round, which the expected error does not know. Set surface.refine_mm.";
}

}  // namespace

std::vector<std::string> area_remarks(const Episode& episode, bool has_parts) {
  const Surface& surface = episode.exploration.surface();
  const Conclusion& conclusion = episode.conclusion();
  const std::optional<Certainty>& certainty = conclusion.certainty;
  const double found_m2 = surface_area(surface, episode.estimate);
  std::vector<std::string> remarks;
  if (found_m2 > kMuchStiff * surface.area())
    remarks.push_back(
        "More than half of the tissue counts as stiff: where a tumour reads less than healthy "
        "tissue, change the readings' sign.");
  if (!certainty) return remarks;
  if (const std::size_t parts = episode.estimate.polygons().size(); parts > 0) {
    if (std::string words = coarse_words(surface, *certainty, found_m2, parts); !words.empty())
      remarks.push_back(std::move(words));
  }
  const double wrong_m2 = certainty->expected.symmetric_difference_m2();
  if (has_parts && wrong_m2 > kLargeShare * found_m2)
    remarks.push_back("The area expected to be wrong is " + share_words(wrong_m2 / found_m2) +
                      " the area found: more readings are needed" + least_known_words(conclusion) +
                      ".");
  else if (const std::optional<double> times = over_reachable(episode);
           times && *times > kMuchOverReachable && wrong_m2 > kSmallShare * found_m2)
    remarks.push_back("The boundary is expected to be wrong by " + fixed(wrong_m2 * 1e6, 1) +
                      " mm2, " + fixed(*times, 0) +
                      " times the least that so many readings with so little noise allow: more "
                      "of them about it would help" +
                      least_known_words(conclusion) + ".");
  return remarks;
}

}  // namespace palpation::tool
