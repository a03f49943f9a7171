#include <array>
#include <memory>
#include <string>
#include <variant>

#include "decision/scoring.h"
#include "palpation/exploration/plan.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/long_call.h"
#include "python/options.h"
#include "python/planned.h"

namespace py = pybind11;
using namespace py::literals;

namespace palpation::python {
namespace {

constexpr std::array<Word<Scaling>, 2> kScalings{
    {{"raw", Scaling::Raw}, {"max", Scaling::MaxScaled}}};
constexpr std::array<Word<Design>, 3> kDesigns{{{"grid", Design::Grid},
                                                {"random", Design::Random},
                                                {"low-discrepancy", Design::LowDiscrepancy}}};
enum class Criterion { Auto, Evr, Ucb, IlsUcb, Straddle, Lse, Randomized, ExpectedError, Random };
constexpr std::array<Word<Criterion>, 9> kCriteria{{{"auto", Criterion::Auto},
                                                    {"evr", Criterion::Evr},
                                                    {"ucb", Criterion::Ucb},
                                                    {"ils-ucb", Criterion::IlsUcb},
                                                    {"straddle", Criterion::Straddle},
                                                    {"lse", Criterion::Lse},
                                                    {"randomized-straddle", Criterion::Randomized},
                                                    {"expected-error", Criterion::ExpectedError},
                                                    {"random", Criterion::Random}}};

/// Copied and destroyed where the interpreter's lock is not held.
std::shared_ptr<py::function> shared(const py::object& function) {
  return {new py::function(py::reinterpret_borrow<py::function>(function)), [](py::function* held) {
            const py::gil_scoped_acquire locked;
            delete held;
          }};
}

/// What a function of arrays says of all vertices.
Field scores_by(const py::function& function, const Marginals& marginals, const Level& level) {
  const py::object scores = function(array_of(marginals.mean),
                                     array_of(Field(marginals.variance.cwiseSqrt())), level.value);
  return numbers_of(scores, {"Plan", "acquisition: its scores"}, marginals.mean.size());
}

Acquisition acquisition_by(const py::object& function) {
  return Whole{[held = shared(function)](const Belief& belief, const Level& level) {
    const Marginals marginals = planning_marginals(belief);
    return in_python([&] { return scores_by(*held, marginals, level); });
  }};
}

Acquisition acquisition_named(const Options& given) {
  const double gamma = given.number("gamma");
  const Scaling scaling = given.choice<Scaling>("scaling", kScalings);
  switch (given.choice<Criterion>("acquisition", kCriteria)) {
    case Criterion::Auto:
    case Criterion::Straddle:
      return straddle();
    case Criterion::Evr:
      return evr();
    case Criterion::Ucb:
      return ucb(gamma, scaling);
    case Criterion::IlsUcb:
      return ils_ucb(gamma, scaling);
    case Criterion::Lse:
      return lse_ambiguity();
    case Criterion::Randomized:
      return randomized_straddle(given.seed("seed"));
    case Criterion::ExpectedError:
      return expected_symmetric_difference();
    case Criterion::Random:
      return random_scores(given.seed("seed"));
  }
  return straddle();
}

py::dict defaults() {
  const Plan plan;
  return py::dict("acquisition"_a = "auto", "gamma"_a = 0.5, "scaling"_a = "raw",
                  "initial_design"_a = word_for<Design>(plan.initial.design, kDesigns),
                  "initial_count"_a = plan.initial.count, "seed"_a = plan.initial.seed,
                  "batch"_a = plan.batch.size, "batches"_a = plan.batches,
                  "least_spacing_m"_a = plan.batch.least_spacing_m, "edge_share"_a = py::none(),
                  "way_reading_m"_a = 0.0, "stop_error_m2"_a = 0.0, "stop_band_m"_a = 0.0,
                  "stop_least_gain"_a = 0.0);
}

bool is_automatic(const py::object& acquisition) {
  return py::isinstance<py::str>(acquisition) && acquisition.cast<std::string>() == "auto";
}

void check_batch(const BatchOptions& batch) {
  require(batch.size >= 0, "Plan", "batch = " + std::to_string(batch.size), "must not be negative");
  require(batch.least_spacing_m >= 0.0, "Plan",
          "least_spacing_m = " + text_of(batch.least_spacing_m), "must not be negative");
  require(batch.way_reading_m >= 0.0, "Plan", "way_reading_m = " + text_of(batch.way_reading_m),
          "must not be negative");
}

Planned planned(const py::kwargs& kwargs) {
  const Options given("Plan", defaults(), kwargs);
  const py::object acquisition = given["acquisition"];
  const bool is_own = PyCallable_Check(acquisition.ptr()) != 0;
  Plan plan;
  plan.acquisition = is_own ? acquisition_by(acquisition) : acquisition_named(given);
  plan.initial = {.design = given.choice<Design>("initial_design", kDesigns),
                  .count = given.integer("initial_count"),
                  .seed = given.seed("seed")};
  plan.batch.size = given.integer("batch");
  plan.batch.least_spacing_m = given.number("least_spacing_m");
  plan.batch.way_reading_m = given.number("way_reading_m");
  plan.batches = given.integer("batches");
  // A criterion that was asked for by name is not to be overridden by another.
  if (!given["edge_share"].is_none())
    plan.aim.edge_share = given.number("edge_share");
  else if (!is_automatic(acquisition))
    plan.aim.edge_share = 0.0;
  plan.stop = {.error_m2 = given.number("stop_error_m2"),
               .band_m = given.number("stop_band_m"),
               .least_gain = given.number("stop_least_gain")};
  check_batch(plan.batch);
  check(plan);
  py::dict values = defaults();
  for (const auto& [name, unused] : values) values[name] = given[name.cast<std::string>().c_str()];
  values["edge_share"] = plan.aim.edge_share;
  return {plan, values};
}

}  // namespace

void bind_plan(py::module_& module) {
  py::class_<Planned>(
      module, "Plan",
      "Where to touch, as far as it is decided beforehand. All arguments are keywords; Plan() "
      "shows their defaults. acquisition: a word ('auto', 'evr', 'ucb', 'ils-ucb', 'straddle', "
      "'lse', 'randomized-straddle', 'expected-error', 'random'), or a function f(mean, stddev, "
      "level) of two arrays over the vertices and a number, which returns an array of scores: the "
      "highest is touched next. It is asked anew for every pick of a batch, with the variance that "
      "the earlier picks will remove. edge_share: None is 0.65 for 'auto' and 0 else.")
      .def(py::init(&planned))
      .def(
          "as_dict", [](const Planned& here) { return here.values.attr("copy")(); },
          "Every argument by its name.")
      .def("__repr__", [](const Planned& here) { return call_text("Plan", here.values); });
}

}  // namespace palpation::python
