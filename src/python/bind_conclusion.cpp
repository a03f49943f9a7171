#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "palpation/base/error.h"
#include "palpation/boundary/level_set.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/concluded.h"
#include "python/long_call.h"
#include "python/readings.h"
#include "scene/boundary_curves.h"

namespace py = pybind11;
using namespace py::literals;

namespace palpation::python {
namespace {

using ConclusionClass = py::class_<Concluded>;

py::object maybe(const std::optional<double>& value) {
  return value ? py::object(py::float_(*value)) : py::object(py::none());
}

const Concluded& of(const py::object& self) { return self.cast<const Concluded&>(); }

/// Where nothing is known of a boundary, nothing.
Region part_above(const Concluded& here, const Field* field, double level) {
  if (field == nullptr || here.conclusion.tip_hides_all()) return Region();
  return long_call([&] { return superlevel_region(here.surface, *field, level); });
}

Region estimate(const Concluded& here) {
  const std::optional<Contour>& contour = here.conclusion.contour;
  return part_above(here, contour ? &contour->field : nullptr, contour ? contour->level : 0.0);
}

Region above_score(const Concluded& here, double score) {
  const std::optional<Certainty>& certainty = here.conclusion.certainty;
  return part_above(here, certainty ? &certainty->score : nullptr, score);
}

py::tuple band(const Concluded& here) {
  const double score = here.conclusion.certainty ? here.conclusion.certainty->band_score : 0.0;
  return py::make_tuple(above_score(here, score), above_score(here, -score));
}

/// What of summary.json is in SI units here, and counted from 0.
py::dict change_of(const Misfit& change) {
  if (change.kind == MisfitKind::Tilted) {
    const Vec3& slope = change.background.slope_per_m;
    return py::dict("kind"_a = std::string(name_of(change.kind)),
                    "slope_per_m"_a = py::make_tuple(slope.x(), slope.y(), slope.z()));
  }
  if (change.kind == MisfitKind::Waves)
    return py::dict("kind"_a = std::string(name_of(change.kind)),
                    "waves"_a = change.background.waves,
                    "length_m"_a = change.background.wave_scale.length_m);
  if (change.kind == MisfitKind::Drift)
    return py::dict("kind"_a = std::string(name_of(change.kind)),
                    "drift"_a = change.background.drift,
                    "readings"_a = change.background.errors.readings);
  if (change.kind == MisfitKind::Late)
    return py::dict("kind"_a = std::string(name_of(change.kind)), "lag_m"_a = change.amount);
  const Vec3& to = change.moved_m;
  py::dict result("kind"_a = std::string(name_of(change.kind)), "batch"_a = change.from_batch,
                  "reading"_a = change.number);
  if (change.kind == MisfitKind::Gain) result["factor"] = 1.0 + change.amount;
  if (change.kind == MisfitKind::Moved) result["moved_m"] = py::make_tuple(to.x(), to.y(), to.z());
  if (change.kind != MisfitKind::Zero) return result;
  result["amount"] = change.amount;
  result["amount_sd"] = change.stddev;
  return result;
}

py::list changes_of(const Conclusion& conclusion) {
  py::list changes;
  for (const SessionChange& session : session_changes(conclusion)) {
    py::dict change = change_of(session.zero);
    change["session"] = session.zero.session;
    if (session.gain) {
      change["factor"] = session.gain->mean;
      change["factor_interval"] = py::make_tuple(session.gain->least, session.gain->most);
    }
    changes.append(change);
  }
  for (const Misfit& change : other_changes(conclusion)) changes.append(change_of(change));
  return changes;
}

py::object core_of(const Conclusion& all) {
  if (!all.outlines || !all.outlines->core) return py::none();
  const DrawnCore& core = *all.outlines->core;
  const Vec3 at = all.belief.prior().surface().position(core.where);
  return py::dict("position_m"_a = py::make_tuple(at.x(), at.y(), at.z()),
                  "probability"_a = core.probability, "area_m2"_a = core.area_m2.mean,
                  "beside"_a = core.beside.mean,
                  "beside_interval"_a = py::make_tuple(core.beside.least, core.beside.most),
                  "with_m2"_a = core.with_m2, "without_m2"_a = core.without_m2);
}

py::object wandering_of(const Conclusion& all) {
  if (!all.outlines || !all.outlines->misfit.wandering) return py::none();
  const WanderingPlaces& wandering = *all.outlines->misfit.wandering;
  return py::dict("way_m"_a = wandering.way_m.mean, "lasting"_a = wandering.lasting.mean,
                  "way_interval_m"_a = py::make_tuple(wandering.way_m.least, wandering.way_m.most),
                  "farthest_number"_a = wandering.farthest + 1,
                  "farthest_m"_a = wandering.farthest_m);
}

py::dict summary(const Concluded& here) {
  const Conclusion& all = here.conclusion;
  const Belief& belief = all.belief;
  const std::optional<Level> level = level_in_readings(all);
  py::dict result(
      "readings"_a = all.palpations.size(), "contrast_seen"_a = all.evidence.contrast_seen,
      "length_m"_a = belief.prior().kernel().length_m, "signal_sd"_a = belief.signal_sd(),
      "noise_sd"_a = std::sqrt(belief.noise_variance()),
      "level"_a = level ? py::object(py::float_(level->value)) : py::none(),
      "level_sd"_a = level ? maybe(level->stddev) : py::none(),
      "transform"_a = all.scale() == ReadingScale::Log ? "log" : "none",
      "transform_is_open"_a = all.evidence.area_by_logarithms_m2.has_value(),
      "tip_hides_all"_a = all.tip_hides_all(), "expected_error_m2"_a = py::none(),
      "expected_missed_m2"_a = py::none(), "expected_extra_m2"_a = py::none(),
      "expected_untouched_m2"_a = py::none(), "plateau_probability"_a = py::none(),
      "noise_inside"_a = py::none(), "band_probability"_a = py::none(),
      "band_half_width_m"_a = py::none());
  if (all.certainty && !all.tip_hides_all()) {
    const Certainty& certainty = *all.certainty;
    result["expected_error_m2"] = certainty.expected.symmetric_difference_m2();
    result["expected_missed_m2"] = certainty.expected.missed_m2;
    result["expected_extra_m2"] = certainty.expected.extra_m2;
    result["expected_untouched_m2"] = certainty.untouched_error_m2;
    result["band_probability"] = certainty.probability;
    result["band_half_width_m"] = certainty.half_width_m;
  }
  if (all.outlines) {
    result["plateau_probability"] = all.outlines->plateau_probability;
    result["noise_inside"] = all.outlines->noise_inside.mean;
  }
  result["core"] = core_of(all);
  result["wandering"] = wandering_of(all);
  result["taken_back"] = changes_of(all);
  const std::optional<Misfit>& step = all.evidence.zero_or_tissue;
  result["zero_or_tissue"] = step ? py::object(change_of(*step)) : py::none();
  py::list doubtful;
  for (const DoubtfulPart& part : all.evidence.doubtful) {
    const Vec3 at = belief.prior().surface().position(part.where);
    doubtful.append(py::dict("position_m"_a = py::make_tuple(at.x(), at.y(), at.z()),
                             "area_m2"_a = part.area_m2, "border_share"_a = part.border_share));
  }
  result["doubtful"] = doubtful;
  if (all.lag) {
    result["lag_m"] = all.lag->value_m;
    result["lag_sd_m"] = all.lag->stddev_m;
  }
  return result;
}

/// The names and numbers of surface.vtp, but for what only a plan or a truth could tell.
py::dict fields(const Concluded& here) {
  const Conclusion& all = here.conclusion;
  py::dict result("mean"_a = array_of(here.mean), "stddev"_a = array_of(here.stddev));
  if (all.belief.prior().has_slope()) {
    const ReadingScale scale = all.scale();
    result["mean_detrended"] = array_of(Field(
        all.component.mean.unaryExpr([scale](double value) { return as_reading(scale, value); })));
  }
  if (all.contour && all.level && all.belief.site_count() > 0)
    result["above_level"] = array_of(Field(all.contour->field.array() - all.contour->level));
  if (all.certainty) {
    result["score"] = array_of(all.certainty->score);
    result["probability_inside"] = array_of(here.probability_inside);
  }
  if (!here.surface.is_planar()) {
    const Points2& uv = *long_call([&] { return &here.surface.chart().uv; });
    result["chart_u"] = array_of(Field(uv.col(0)));
    result["chart_v"] = array_of(Field(uv.col(1)));
  }
  return result;
}

/// Those of boundary.vtp, but for the truth.
std::vector<BoundaryCurve> curves_of(const Concluded& here, double risk) {
  const Conclusion& all = here.conclusion;
  std::vector<BoundaryCurve> curves;
  const auto add = [&](const Field& field, double level, CurveKind kind) {
    const auto more = tool::boundary_curves(here.surface, field, level, kind);
    curves.insert(curves.end(), more.begin(), more.end());
  };
  if (all.tip_hides_all()) return curves;
  if (all.contour && all.level && all.belief.site_count() > 0)
    add(all.contour->field, all.contour->level, CurveKind::Estimate);
  if (all.certainty) {
    add(all.certainty->score, all.certainty->band_score, CurveKind::BandInner);
    add(all.certainty->score, -all.certainty->band_score, CurveKind::BandOuter);
    add(all.certainty->score, Certainty::cut_score(risk), CurveKind::Cut);
  }
  return curves;
}

py::list curves(const Concluded& here, double risk) {
  py::list result;
  for (const BoundaryCurve& curve : long_call([&] { return curves_of(here, risk); })) {
    Points points(static_cast<Eigen::Index>(curve.points.size()), 3);
    for (Eigen::Index row = 0; row < points.rows(); ++row)
      points.row(row) = curve.points[static_cast<std::size_t>(row)].transpose();
    result.append(py::dict("kind"_a = name_of(curve.kind), "part"_a = curve.part,
                           "hole"_a = curve.hole, "points"_a = array_of(points)));
  }
  return result;
}

void bind_fields(ConclusionClass& conclusion) {
  conclusion
      .def_property_readonly(
          "mean", [](const py::object& self) { return view_of(of(self).mean, self); },
          "Of the field at the vertices, in the readings' unit, read-only.")
      .def_property_readonly(
          "stddev", [](const py::object& self) { return view_of(of(self).stddev, self); },
          "Of the field at the vertices, noise not in it, read-only.")
      .def_property_readonly(
          "probability_inside",
          [](const py::object& self) -> py::object {
            if (!of(self).conclusion.certainty) return py::none();
            return view_of(of(self).probability_inside, self);
          },
          "Of being tumour, at the vertices, read-only; None while there is no level.")
      .def_property_readonly(
          "score",
          [](const py::object& self) -> py::object {
            if (!of(self).conclusion.certainty) return py::none();
            return view_of(of(self).conclusion.certainty->score, self);
          },
          "How many standard deviations each vertex lies inside the boundary, read-only; None "
          "while there is no level.");
}

}  // namespace

void bind_conclusion(py::module_& module) {
  ConclusionClass conclusion(module, "Conclusion",
                             "All that was inferred from the readings so far. Immutable.");
  bind_fields(conclusion);
  conclusion.def_property_readonly("surface", [](const Concluded& here) { return here.surface; })
      .def_property_readonly(
          "readings",
          [](const Concluded& here) {
            return Readings{here.surface, here.conclusion.palpations};
          },
          "As they were made, with the reason where one is set aside.")
      .def_property_readonly(
          "level",
          [](const Concluded& here) {
            const std::optional<Level> level = level_in_readings(here.conclusion);
            return level ? py::object(py::float_(level->value)) : py::object(py::none());
          },
          "Where tissue becomes tumour, in the readings' unit; None while nothing tells.")
      .def("region", &estimate, "The tumour as it is believed; empty where none is.")
      .def("band", &band,
           "(inner, outer): the whole true outline lies between their borders with "
           "summary()['band_probability'].")
      .def(
          "cut",
          [](const Concluded& here, double risk) {
            return above_score(here, Certainty::cut_score(risk));
          },
          py::kw_only(), "risk"_a = 0.05,
          "Outside of it a place is tumour with this probability at most.")
      .def("fields", &fields,
           "The arrays of surface.vtp by their names: 'mean', 'stddev', and, where they are known, "
           "'above_level', 'score', 'probability_inside', and so on; copies.")
      .def("curves", &curves, py::kw_only(), "risk"_a = 0.05,
           "The closed lines of boundary.vtp, a dict each: 'kind' ('estimate', 'band_inner', "
           "'band_outer', 'cut' at that risk), 'part', 'hole', and 'points' (n x 3, metres, the "
           "first not repeated).")
      .def("summary", &summary, "The numbers by their names; what is not known is None.")
      .def("__repr__", [](const Concluded& here) {
        const std::optional<Level> level = level_in_readings(here.conclusion);
        return "<palpation.Conclusion: " + std::to_string(here.conclusion.palpations.size()) +
               " readings, " + (level ? "level " + text_of(level->value) : "no level") + ">";
      });
  module.def(
      "conclude",
      [](const Readings& readings, const Model& model, std::optional<std::uint64_t> seed) {
        return long_call([&] {
          return Concluded(readings.surface,
                           conclude(readings.surface, model, readings.palpations, nullptr, seed));
        });
      },
      "readings"_a, "model"_a = Model(), py::kw_only(), "sampling_seed"_a = py::none(),
      "All that follows from readings: the field, the level, the boundary and how sure it is. With "
      "sampling_seed the boundary's outlines are drawn, which takes seconds and is honest about "
      "corners, horns and necks: what the tool does when all is felt.");
}

}  // namespace palpation::python
