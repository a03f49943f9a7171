#include <array>
#include <string>

#include "palpation/exploration/model.h"
#include "python/bindings.h"
#include "python/options.h"

namespace py = pybind11;
using namespace py::literals;

namespace palpation::python {
namespace {

constexpr std::array<Word<Metric>, 3> kMetrics{
    {{"chart", Metric::Chart}, {"ambient", Metric::Ambient}, {"intrinsic", Metric::Intrinsic}}};
constexpr std::array<Word<KernelFamily>, 5> kKernels{
    {{"squared-exponential", KernelFamily::SquaredExponential},
     {"matern-1/2", KernelFamily::Matern12},
     {"matern-3/2", KernelFamily::Matern32},
     {"matern-5/2", KernelFamily::Matern52},
     {"periodic", KernelFamily::Periodic}}};
enum class TrendWord { Constant, Linear, Zero };
constexpr std::array<Word<TrendWord>, 3> kTrends{
    {{"constant", TrendWord::Constant}, {"linear", TrendWord::Linear}, {"zero", TrendWord::Zero}}};
constexpr std::array<Word<std::optional<ReadingScale>>, 3> kTransforms{
    {{"none", ReadingScale::Raw}, {"log", ReadingScale::Log}, {"auto", std::nullopt}}};
constexpr std::array<Word<LevelEstimate>, 2> kEstimates{
    {{"edge", LevelEstimate::Edge}, {"range", LevelEstimate::Range}}};

TrendWord trend_of(const Trend& trend) {
  if (trend.is_linear) return TrendWord::Linear;
  return trend.constant.sd == 0.0 ? TrendWord::Zero : TrendWord::Constant;
}

py::dict dictionary_of(const Model& model) {
  const FieldModel& field = model.field;
  const LevelRule& level = model.level;
  py::object known = py::none();
  if (level.known) known = py::float_(*level.known);
  py::object least = py::none(), probability = py::none();
  if (model.band) probability = py::float_(model.band->probability);
  if (model.contrast.least) least = py::float_(*model.contrast.least);
  return py::dict(
      "metric"_a = word_for<Metric>(field.metric, kMetrics),
      "kernel"_a = word_for<KernelFamily>(field.kernel.family, kKernels),
      "length_m"_a = value_of(field.kernel.length_m),
      "signal_sd"_a = value_of(field.kernel.signal_sd), "noise_sd"_a = value_of(field.noise.sd),
      "trend"_a = word_for<TrendWord>(trend_of(field.trend), kTrends),
      "standardize"_a = field.standardize, "lag_m"_a = value_of(field.probe.lag_m),
      "indenter_radius_m"_a = field.probe.indenter_radius_m, "screening"_a = field.probe.screening,
      "length_median_m"_a = field.kernel.length_median_m, "period_m"_a = field.kernel.period_m,
      "level"_a = known, "level_fraction"_a = level.fraction,
      "level_estimate"_a = word_for<LevelEstimate>(level.estimate, kEstimates),
      "band_probability"_a = probability, "safe_start"_a = model.contrast.safe_start,
      "transform"_a = word_for<std::optional<ReadingScale>>(model.contrast.scale, kTransforms),
      "min_contrast"_a = least);
}

FieldModel field_of(const Options& given) {
  FieldModel field{.metric = given.choice<Metric>("metric", kMetrics),
                   .standardize = given.truth("standardize")};
  field.kernel = {.family = given.choice<KernelFamily>("kernel", kKernels),
                  .length_m = given.learnable("length_m"),
                  .signal_sd = given.learnable("signal_sd"),
                  .length_median_m = given.number("length_median_m"),
                  .period_m = given.number("period_m")};
  field.noise.sd = given.learnable("noise_sd");
  const TrendWord trend = given.choice<TrendWord>("trend", kTrends);
  field.trend.is_linear = trend == TrendWord::Linear;
  if (trend == TrendWord::Zero) field.trend.constant.sd = 0.0;
  field.probe = {.lag_m = given.learnable("lag_m"),
                 .indenter_radius_m = given.number("indenter_radius_m"),
                 .screening = given.truth("screening")};
  return field;
}

/// Lengths that nothing below looks at until they matter.
void check_lengths(const FieldModel& field) {
  require(field.kernel.length_median_m > 0.0, "Model",
          "length_median_m = " + text_of(field.kernel.length_median_m), "must be positive");
  require(field.probe.indenter_radius_m >= 0.0, "Model",
          "indenter_radius_m = " + text_of(field.probe.indenter_radius_m), "must not be negative");
  check(kernel_of(field.kernel));
}

Model model_of(const py::kwargs& kwargs) {
  const Options given("Model", dictionary_of(Model()), kwargs);
  Model model{.field = field_of(given)};
  if (!given["level"].is_none()) model.level.known = given.number("level");
  model.level.fraction = given.number("level_fraction");
  model.level.estimate = given.choice<LevelEstimate>("level_estimate", kEstimates);
  if (given["band_probability"].is_none())
    model.band.reset();
  else
    model.band->probability = given.number("band_probability");
  model.contrast.safe_start = given.truth("safe_start");
  model.contrast.scale = given.choice<std::optional<ReadingScale>>("transform", kTransforms);
  if (!given["min_contrast"].is_none()) model.contrast.least = given.number("min_contrast");
  check_lengths(model.field);
  check(model);
  return model;
}

}  // namespace

void bind_model(py::module_& module) {
  py::class_<Model>(module, "Model",
                    "What is taken for true of tissue, probe and tumour before anything is "
                    "concluded. All arguments are keywords; Model() shows their defaults. "
                    "length_m, signal_sd, noise_sd and lag_m: numbers, or 'learn'. metric: "
                    "'chart', 'ambient' or 'intrinsic'. level: where it is known, in the "
                    "readings' unit. Names and meanings are those of a scene: palpate help scene.")
      .def(py::init(&model_of))
      .def("as_dict", &dictionary_of, "Every argument by its name.")
      .def("__repr__", [](const Model& model) { return call_text("Model", dictionary_of(model)); });
}

}  // namespace palpation::python
