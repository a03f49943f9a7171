#include "scene/scene_schema.h"

#include <utility>

#include "palpation/exploration/model.h"
#include "palpation/world/catalogue.h"
#include "scene/bound_keys.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr double kLeastLength_mm = 1e-6;
constexpr double kMostLength_mm = 1e6;
/// Readings may have any unit; their squares and the ratios of these must be doubles.
constexpr double kLeastReading = 1e-30;
constexpr double kMostReading = 1e30;
constexpr double kMostDirection = 1e6;
constexpr double kMostSeed = 9007199254740991.0;  // beyond it not every whole number is a double
constexpr int kMostTumours = 100;
constexpr int kMostCorners = 10000;
constexpr int kMostWishes = 1000;
/// In place of a default: the one of the member that the key sets (bound_keys.h), if it has any.
constexpr std::nullptr_t kBound = nullptr;

SceneKey key(std::string path, ValueKind kind, std::string unit, std::string meaning) {
  SceneKey key;
  key.path = std::move(path);
  key.kind = kind;
  key.unit = std::move(unit);
  key.meaning = std::move(meaning);
  return key;
}

SceneKey in_range(SceneKey key, double least, double most, json standard) {
  key.least = least;
  key.most = most;
  key.standard = std::move(standard);
  return key;
}

SceneKey number(std::string path, std::string unit, double least, double most, json standard,
                std::string meaning) {
  return in_range(key(std::move(path), ValueKind::Number, std::move(unit), std::move(meaning)),
                  least, most, std::move(standard));
}

SceneKey integer(std::string path, double least, double most, json standard, std::string meaning) {
  return in_range(key(std::move(path), ValueKind::Integer, "", std::move(meaning)), least, most,
                  std::move(standard));
}

SceneKey truth(std::string path, json standard, std::string meaning) {
  SceneKey result = key(std::move(path), ValueKind::Truth, "", std::move(meaning));
  result.standard = std::move(standard);
  return result;
}

SceneKey word(std::string path, std::vector<std::string> words, json standard,
              std::string meaning) {
  SceneKey result = key(std::move(path), ValueKind::Word, "", std::move(meaning));
  result.words = std::move(words);
  result.standard = std::move(standard);
  return result;
}

SceneKey number_or_learn(std::string path, std::string unit, double least, double most,
                         std::string meaning) {
  SceneKey result =
      number(std::move(path), std::move(unit), least, most, kBound, std::move(meaning));
  result.kind = ValueKind::NumberOrWord;
  result.words = {"learn"};
  return result;
}

SceneKey bound_word(std::string path, std::string meaning) {
  return word(std::move(path), {}, kBound, std::move(meaning));
}

SceneKey text(std::string path, std::string meaning) {
  return key(std::move(path), ValueKind::Text, "", std::move(meaning));
}

SceneKey numbers(std::string path, int count, std::string unit, double least, double most,
                 json standard, std::string meaning) {
  SceneKey result = number(std::move(path), std::move(unit), least, most, std::move(standard),
                           std::move(meaning));
  result.kind = ValueKind::Numbers;
  result.count = count;
  return result;
}

SceneKey or_zero(SceneKey key) {
  key.zero_too = true;
  return key;
}

SceneKey integers(SceneKey numbers) {
  numbers.kind = ValueKind::Integers;
  return numbers;
}

SceneKey points(SceneKey numbers) {
  numbers.kind = ValueKind::Points;
  return numbers;
}

SceneKey balls(SceneKey numbers) {
  numbers.kind = ValueKind::Balls;
  return numbers;
}

SceneKey tumours(std::string path, int most, std::string meaning) {
  SceneKey result = key(std::move(path), ValueKind::Tumours, "", std::move(meaning));
  result.count = most;
  result.standard = json::array();
  return result;
}

std::vector<std::string> names_of_worlds() {
  std::vector<std::string> names;
  for (const WorldFamily& family : world_families()) names.push_back(family.name);
  return names;
}

std::vector<SceneKey> make_scene_keys() {
  return {
      integer("version", kSceneVersion, kSceneVersion, kSceneVersion, "of this format"),
      word("speed", {"exact", "fast", "draft"}, "exact",
           "a choice of plan.explore_mm and error.arithmetic, each of which can be given by "
           "itself; palpate experiment tradeoff tells what "
           "they cost on a scene"),
      text("reading_unit",
           "what the readings are measured in, such as N/mm; where measurements have a column "
           "reading_unit, it must say the same"),
      text("surface.mesh",
           "the tissue: an OBJ, OFF, STL, PLY or VTP file, relative to the scene, or where there "
           "is none to where palpate runs"),
      word("surface.unit", {"mm", "cm", "m"}, nullptr,
           "of the mesh's coordinates; needed with surface.mesh"),
      word("surface.frame", {"RAS", "LPS"}, nullptr,
           "whose frame the mesh's coordinates are in, where it is a patient's: x to the right, y "
           "to the front, z to the head (RAS), or x to the left, y to the back, z to the head "
           "(LPS); 3D Slicer must know; nobody guesses it"),
      word("surface.off_tissue", {"leave-out", "refuse"}, "leave-out",
           "measurements more than 5 mm above or below the tissue, or 1 mm beside its border: left "
           "out and told, or their file is refused; a file all of which lies off is refused"),
      truth("surface.weld", false,
            "vertices of the mesh at exactly the same place become one; STL corners always do"),
      numbers("surface.plane.size_mm", 2, "mm", 0.01, 2000.0, nullptr,
              "in place of a mesh: a flat rectangle from the origin, along x and y, its longer "
              "side 1 mm at least"),
      integers(numbers("surface.plane.vertices", 2, "", 2, 20000, json{200, 200},
                       "of that rectangle, along x and y; 4 million at most in all")),
      number("surface.refine_mm", "mm", kLeastLength_mm, kMostLength_mm, nullptr,
             "split triangles until no edge is longer; 8 million triangles at most"),
      numbers("surface.patch.centre_mm", 3, "mm", -kMostLength_mm, kMostLength_mm, nullptr,
              "work on the tissue around the surface point nearest to this"),
      number("surface.patch.radius_mm", "mm", kLeastLength_mm, kMostLength_mm, nullptr,
             "and no farther from it, walking along the surface"),
      numbers("surface.patch.box_mm", 6, "mm", -kMostLength_mm, kMostLength_mm, nullptr,
              "work on the triangles inside a box, from its corner at the first three numbers to "
              "the one at the last three: of their parts "
              "the one nearest to centre_mm, or else the largest"),
      numbers("surface.patch.facing", 3, "", -kMostDirection, kMostDirection, nullptr,
              "work on the triangles that face this direction, parts as for the box; not zero"),
      number("surface.patch.within_deg", "degrees", 1e-3, 180.0, 60.0,
             "how far their normals may be from it"),
      bound_word(
          "field.metric",
          "distance between places: in the chart, straight through space, or along the surface by "
          "its Laplacian"),
      bound_word("field.kernel", "covariance of the stiffness at two places"),
      number_or_learn(
          "field.length_mm", "mm", kLeastLength_mm, kMostLength_mm,
          "over which stiffness changes; a millionth to a million times the tissue's size"),
      number_or_learn("field.signal_sd", "reading", kLeastReading, kMostReading,
                      "prior standard deviation of the stiffness; a fixed value with standardize: "
                      "multiples of the readings' own"),
      or_zero(
          number_or_learn("field.noise", "reading", kLeastReading, kMostReading,
                          "standard deviation of a reading; 0: repeats at one place must agree")),
      or_zero(number("field.noise_to_signal", "", 1e-12, 1e6, nullptr,
                     "in place of field.noise: the same as a fraction of a fixed signal_sd")),
      number("field.length_prior_mm", "mm", kLeastLength_mm, kMostLength_mm, kBound,
             "what a learned length is likely to be: the median of a lognormal prior (spread 0.4)"),
      number("field.period_mm", "mm", kLeastLength_mm, kMostLength_mm, kBound,
             "period of the periodic kernel, the same along both axes; needed with it, and without "
             "effect on others"),
      bound_word(
          "field.trend",
          "mean of the field before any reading; linear: a constant and a slope, which a tilt of "
          "the tissue or a drifting sensor adds: "
          "level and boundary are of the field without it"),
      or_zero(number("field.constant_sd", "reading", kLeastReading, kMostReading, kBound,
                     "how well that constant is known beforehand (as signal_sd); left out: not at "
                     "all; without effect on a trend of zero")),
      truth("field.standardize", true,
            "readings are z-scored, as GPy does; where anything is learned it matters only to a "
            "trend of zero, which is then about their "
            "mean"),
      bound_word(
          "field.transform",
          "log: a field of the readings' logarithms, for readings that are positive and skewed, "
          "as real tissue's often are; the level's fraction is then of the way between logarithms; "
          "auto: where readings differ twofold, an edge makes logarithms more probable, and no "
          "value is given in the reading's unit (plan.min_contrast, field.signal_sd, field.noise, "
          "field.constant_sd, level.value)"),
      bound_word("field.precision",
                 "single: half the memory of the field's model and less time, the field off by a "
                 "ten-thousandth of the signal at most; for noise of 3.2 % of the signal and more: "
                 "where a learned noise is lower, double is taken"),
      or_zero(number(
          "field.reduced_rank", "", 1e-13, 1e-4, kBound,
          "for readings by the thousand, as along paths: the part of the prior's variance that may "
          "be left out, 1e-10 say, so that "
          "a smooth field is modelled by some hundreds of features whatever the readings' number; "
          "bounded, and exact where that "
          "does not pay (rough kernels, few readings) or their noise is too small; 0: exact")),
      number("field.rebuild_gain", "nats", 0.0, 100.0, kBound,
             "how much better other hyperparameters must explain the readings before the field is "
             "built anew with them, 0.5 say; until "
             "then it grows by the new readings alone, and the next plan follows the last of them "
             "sooner; 0: the best ones always"),
      number("field.indenter_radius_mm", "mm", 0.0, 20.0, kBound,
             "of the probe's round tip, which feels an edge by as much too early: the boundary is "
             "drawn that much inwards; 0: not at all"),
      truth("field.heavy_tails", false,
            "does nothing: that a reading may tell nothing is part of the noise, always"),
      truth(
          "field.screening", kBound,
          "the readings are scans whose rows may be at fault, which is set aside with the reason "
          "in measurements.csv: jams, start-ups, base steps between rows; and contact may fade to "
          "one side; tissue that is stiff along a row, or half of it, would be taken for such. A "
          "sensor that hangs, lost contact here and there "
          "and what readings around contradict are found without it"),
      number_or_learn("field.lag_mm", "mm", -10.0, 10.0,
                      "how far behind the probe's travel its readings belong; 0: "
                      "readings belong where they are made; "
                      "learned ones lie between -0.5 and 3 mm"),
      bound_word(
          "level.estimate",
          "where tissue becomes tumour: known beforehand; min + fraction (max - min) of the mean; "
          "or that fraction of the way between the "
          "plateaus of the readings' profile across the edge, with a standard deviation"),
      number("level.fraction", "", 1e-6, 1.0 - 1e-6, kBound,
             "of that way; it also defines the true outline of a simulated tumour"),
      number("level.value", "reading", -kMostReading, kMostReading, kBound,
             "the level, needed where level.estimate is known; kept, but without effect, where it "
             "is not"),
      word("plan.acquisition",
           {"auto", "ils-ucb", "ucb", "evr", "straddle", "randomized-straddle", "expected-error",
            "lse", "random", "raster", "refinement"},
           "auto",
           "the acquisition function: auto sends most of a batch where it improves the boundary "
           "the most, and the rest where the straddle criterion looks for more tumours; raster and "
           "refinement are the classical scans instead, whose length does not depend on "
           "plan.batches"),
      number("plan.edge_share", "", 0.0, 1.0, kBound,
             "share of a batch that goes to the boundary, where plan.acquisition is auto and "
             "level.estimate edge"),
      number("plan.gamma", "", 0.0, 1.0, 0.5, "for ucb and ils-ucb: 0 explores, 1 exploits"),
      word("plan.scaling", {"raw", "max"}, "raw",
           "for ucb and ils-ucb: as the paper writes them, or both terms divided by their maxima"),
      bound_word("plan.initial.design", "the design of the initial samples"),
      integer("plan.initial.count", 0, 10000, kBound,
              "number of initial samples; no more than the tissue has vertices"),
      integer("plan.batch", 1, 10000, kBound,
              "samples planned together; no more than the tissue has vertices"),
      integer("plan.batches", 0, 100000, kBound, "number of batches after the initial samples"),
      number("plan.least_spacing_mm", "mm", 0.0, kMostLength_mm, kBound,
             "least distance between the stops of a batch"),
      truth("plan.readings_along_path", kBound,
            "in-transit readings: the probe also reads between stops, once per mm"),
      truth("plan.safe_start", kBound,
            "draw no conclusion and explore by variance alone until the readings show contrast "
            "beyond their noise; no effect where field and level are both given"),
      number("plan.stop.expected_error_mm2", "mm2", 0.0, 1e12, kBound,
             "stop once the expected wrong area is no larger, with certainty = sampled by drawn "
             "outlines, too; 0: when the batches are done"),
      number("plan.stop.band_mm", "mm", 0.0, kMostLength_mm, kBound,
             "stop once the band's mean half width is no larger, with certainty = sampled by drawn "
             "outlines, too; 0: when the batches are done"),
      number("plan.stop.least_gain", "", 0.0, 1.0, kBound,
             "stop once three batches reduced the expected wrong area by less than this fraction, "
             "and the next would too; 0: when the batches are done"),
      number(
          "plan.min_contrast", "reading", kLeastReading, kMostReading, kBound,
          "least contrast of a tumour, above healthy tissue (a factor where field.transform is "
          "log): what surely stands out by less is none, and is named; the summary says how wide "
          "one of it can be and still be undetected; left out: whatever stands out, and a tumour "
          "of four times the readings' scatter"),
      number(
          "plan.goal.max_undetected_diameter_mm", "mm", 0.1, kMostLength_mm, kBound,
          "a tumour as wide as this is not to be missed, wherever it is: what is not spent on the "
          "boundary goes first where one could still hide, and the run says so where one can; "
          "left out: no such goal"),
      number(
          "plan.goal.probability", "", 0.01, 1.0 - 1e-6, kBound,
          "with which such a tumour is to be found; its contrast is plan.min_contrast, else that "
          "of what was found, else four times the readings' scatter"),
      or_zero(number("plan.explore_mm", "mm", 0.05, 3.0, 0.0,
                     "plan on a coarser mesh with edges of this length, and infer the boundary on "
                     "the full one at the end; 0: all on the full one; without effect on palpate "
                     "plan and boundary, and on scans")),
      points(numbers("plan.touch_first_mm", kMostWishes, "mm", -kMostLength_mm, kMostLength_mm,
                     json::array(),
                     "places that the next plan of palpate plan goes to first, each at the vertex "
                     "nearest to it; without effect on other commands")),
      balls(numbers("plan.keep_out_mm", kMostWishes, "mm", -kMostLength_mm, kMostLength_mm,
                    json::array(),
                    "balls in which nothing is touched; the way between two stops may lead over "
                    "them")),
      number("plan.row_spacing_mm", "mm", 0.01, kMostLength_mm, 2.0,
             "of a raster scan's rows, and the coarsest cells of a refinement: four times this"),
      word("probe.kind", {"simulated"}, "simulated",
           "where readings come from in `palpate simulate`"),
      number("probe.low", "reading", -kMostReading, kMostReading, kBound,
             "simulated reading on healthy tissue"),
      number("probe.high", "reading", -kMostReading, kMostReading, kBound,
             "simulated reading deep inside a tumour; above probe.low, by 1e-30 at least and "
             "enough to tell them apart"),
      number("probe.slope_per_m", "1/m", 1e-3, 1e9, kBound, "steepness of the edge between them"),
      number("probe.noise", "", 0.0, 1e6, kBound,
             "standard deviation, as a fraction of high - low"),
      number("probe.bias", "", -1e6, 1e6, kBound,
             "the paper's beta: what is added from one end of the tissue to the other, as a "
             "fraction of high - low"),
      numbers("probe.bias_axis", 3, "", -kMostDirection, kMostDirection, nullptr,
              "along which; not zero; left out: the longest side of the tissue"),
      number("probe.lag_mm", "mm", -100.0, 100.0, kBound,
             "lag of a simulated reading: at x, travelling along t, it is that of x - lag t"),
      tumours("probe.tumours", kMostTumours, "a list of shapes; several may overlap"),
      word("probe.world", names_of_worlds(), nullptr,
           "in place of tumours: what lies there, and what ails the sensor, drawn by the seed from "
           "a family of the catalogue, on flat tissue; its slope and contrasts, too"),
      word("certainty", {"sampled", "laplace", "off"}, "sampled",
           "of the boundary when all is felt: from outlines that are drawn, in seconds, or by "
           "Laplace's approximation, which every plan goes by; off: the boundary alone, without "
           "band, cut line, probabilities and expected error"),
      number("band.probability", "", 0.01, 1.0 - 1e-6, Band{}.probability,
             "probability that the whole true outline lies between the band's two curves"),
      number("band.cut_risk", "", 1e-6, 0.5, 0.05,
             "risk of the cut line: outside of it a place is tumour with at most this probability"),
      numbers("robot.from_tissue", 16, "", -kMostDirection, kMostDirection, kBound,
              "rigid transform to the robot's frame, row by row, its translation in metres"),
      text("robot.registration",
           "in place of robot.from_tissue: a file that palpate register wrote, relative to the "
           "scene; robot.uncertainty_mm is what it says, unless it is given"),
      number("robot.standoff_mm", "mm", 0.0, 1000.0, kBound,
             "height of the approach point above the tissue"),
      number("robot.indent_mm", "mm", 0.0, 100.0, kBound, "how deep the probe presses"),
      number("robot.spring_n_per_m", "N/m", 0.0, 1e9, kBound,
             "of the probe's tip: what waypoints.csv expects of the force follows from it and "
             "robot.indent_mm"),
      number("robot.margin_mm", "mm", 0.0, 1000.0, 0.0,
             "no stop comes nearer to the tissue's border than this, along the tissue, where a "
             "probe may slip off; 0: it may"),
      numbers("robot.shaft_direction", 3, "", -kMostDirection, kMostDirection, nullptr,
              "from the tissue along the probe's shaft, in the robot's frame: only tissue whose "
              "normal is near it is touched; left out: all"),
      number("robot.cone_deg", "degrees", 1e-3, 180.0, kBound,
             "the greatest angle between the two"),
      number("robot.clearance_mm", "mm", 0.0, 1000.0, kBound,
             "tissue is touched only where a line of this length along its normal does not meet "
             "tissue again; 0: everywhere"),
      number("robot.probe_radius_mm", "mm", 0.0, 100.0, kBound,
             "of the probe, whose tip is round: over robot.clearance_mm it must have room as well; "
             "0: a line"),
      number(
          "robot.uncertainty_mm", "mm", 0.01, 100.0, kBound,
          "how far, along its normal, the tissue may lie from where it is taken to be: it widens "
          "the stretch that the gate lets the probe search for contact, and nothing else"),
      number("robot.place_uncertainty_mm", "mm", 0.0, 100.0, 0.0,
             "how far, with 95 %, all that is felt may lie off along the tissue, the same way: the "
             "band is wider by it; left out: what robot.registration says"),
      text("robot.frame",
           "the frame_id of the arm's poses; the gate refuses any other; left out: none is named"),
      number("robot.limits.contact_n", "N", 1e-3, 1e3, kBound, "from here on the tip touches"),
      number("robot.limits.warn_n", "N", 1e-3, 1e3, kBound,
             "from here on the gate lets the tip only go back; above contact_n"),
      number("robot.limits.hold_n", "N", 1e-3, 1e3, kBound,
             "from here on the arm holds until a person acknowledges; above warn_n"),
      number(
          "robot.limits.stiffest_n_per_mm", "N/mm", 1e-3, 1e4, kBound,
          "of the tissue: what it adds at contact speed while data get old must lead from warn_n "
          "to hold_n at most"),
      number("robot.limits.frozen_ms", "ms", 0.0, 1e4, kBound,
             "a force that is the same to the last digit for so long, while the tip looks for "
             "contact or presses, is of a sensor that is stuck; 0: it may be"),
      number("robot.limits.air_mm_per_s", "mm/s", 0.01, 1e3, kBound, "fastest over the tissue"),
      number("robot.limits.contact_mm_per_s", "mm/s", 0.01, 1e3, kBound,
             "fastest in search of contact, pressing and going back"),
      number("robot.limits.step_mm", "mm", 1e-3, 100.0, kBound, "from one set point to the next"),
      number("robot.limits.astray_mm", "mm", 0.01, 100.0, kBound,
             "farthest of the tip from where it was sent"),
      number("robot.limits.extra_indent_mm", "mm", 1e-3, 100.0, kBound,
             "deepest beyond robot.indent_mm, from where it touched"),
      number("robot.limits.cone_deg", "degrees", 0.1, 89.0, kBound,
             "greatest angle between the probe's axis and the tissue's inward normal at a touch"),
      number("robot.limits.data_age_ms", "ms", 1.0, 1e4, kBound, "oldest pose and force"),
      numbers("robot.limits.box_mm", 6, "mm", -kMostLength_mm, kMostLength_mm, nullptr,
              "the tip stays in this box in the robot's frame, from its least corner to its "
              "greatest; left out: 20 mm and the way in and out around the tissue"),
      word("error.arithmetic", {"exact", "plain"}, "exact",
           "of the error against a known truth: exact Booleans of polygons, with distances; or "
           "areas summed triangle by triangle, without"),
      integer("seed", 0, kMostSeed, kBound, "seed of all random numbers"),
  };
}

/// What stands at the members that keys set: their defaults and words.
std::vector<SceneKey> with_members(std::vector<SceneKey> keys) {
  for (SceneKey& key : keys) {
    const std::optional<FromMember> member = from_member(key.path);
    if (!member) continue;
    if (key.standard.is_null()) key.standard = member->standard;
    if (key.kind == ValueKind::Word) key.words = member->words;
  }
  return keys;
}

}  // namespace

const std::vector<SceneKey>& scene_keys() {
  static const std::vector<SceneKey> keys = with_members(make_scene_keys());
  return keys;
}

const std::vector<std::string>& tumour_shapes() {
  static const std::vector<std::string> shapes = {"disk", "horseshoe", "polygon"};
  return shapes;
}

const std::vector<SceneKey>& tumour_keys(const std::string& shape) {
  static const SceneKey centre =
      numbers("centre_mm", 3, "mm", -kMostLength_mm, kMostLength_mm, nullptr,
              "in the mesh's frame, taken to the closest surface point");
  static const std::vector<SceneKey> disk = {
      centre,
      number("radius_mm", "mm", kLeastLength_mm, kMostLength_mm, nullptr, "along the surface")};
  static const std::vector<SceneKey> horseshoe = {
      centre,
      number("arc_radius_mm", "mm", kLeastLength_mm, kMostLength_mm, nullptr, "of the middle line"),
      number("half_width_mm", "mm", kLeastLength_mm, kMostLength_mm, nullptr,
             "on both sides of it, with round caps; below arc_radius_mm"),
      number("arc_deg", "degrees", 1e-3, 360.0, 180.0, "the solid part"),
      numbers("facing", 3, "", -kMostDirection, kMostDirection, json{1, 0, 0},
              "from the centre to the middle of the arc"),
  };
  static const std::vector<SceneKey> polygon = {
      points(numbers("points_mm", kMostCorners, "mm", -kMostLength_mm, kMostLength_mm, nullptr,
                     "corners, at least 3, in order, not crossing; the last may repeat the first")),
  };
  return shape == "disk" ? disk : shape == "horseshoe" ? horseshoe : polygon;
}

}  // namespace palpation::tool
