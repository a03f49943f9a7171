#include "scene/bound_keys.h"

#include <map>

#include "scene/bind.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

BoundKey<FieldModel> trend_key() {
  return {"field.trend",
          [](const FieldModel& field) -> json {
            if (field.trend.is_linear) return "linear";
            return field.trend.constant.sd == 0.0 ? "zero" : "constant";
          },
          [](FieldModel& field, const json& value) {
            field.trend.is_linear = value == "linear";
            if (value == "zero") field.trend.constant.sd = 0.0;
          },
          {"zero", "constant", "linear"}};
}

/// Without effect on a trend of zero.
BoundKey<FieldModel> constant_key() {
  return {"field.constant_sd",
          [](const FieldModel& field) { return told(field.trend.constant.sd, kAsIs); },
          [](FieldModel& field, const json& value) {
            if (field.trend.constant.sd != 0.0) take(field.trend.constant.sd, value, kAsIs);
          }};
}

/// Forgets a level that is given, but not asked for: after level.value.
BoundKey<Model> estimate_key() {
  return {"level.estimate",
          [](const Model& model) -> json {
            if (model.level.known) return "known";
            return model.level.estimate == LevelEstimate::Range ? "range" : "edge";
          },
          [](Model& model, const json& value) {
            if (value != "known") model.level.known.reset();
            if (value == "range") model.level.estimate = LevelEstimate::Range;
          },
          {"known", "range", "edge"}};
}

BoundKey<Plan> way_key() {
  return {"plan.readings_along_path",
          [](const Plan& plan) -> json { return plan.batch.way_reading_m > 0.0; },
          [](Plan& plan, const json& value) {
            plan.batch.way_reading_m = value.get<bool>() ? kWayStep_m : 0.0;
          }};
}

}  // namespace

const BoundKeys<FieldModel>& field_keys() {
  using Key = Bind<FieldModel>;
  using Field = FieldModel;
  static const BoundKeys<FieldModel> keys = {
      Key::word<Metric>("field.metric",
                        {{"chart", Metric::Chart},
                         {"ambient", Metric::Ambient},
                         {"intrinsic", Metric::Intrinsic}},
                        &Field::metric),
      Key::word<KernelFamily>("field.kernel",
                              {{"squared-exponential", KernelFamily::SquaredExponential},
                               {"matern-1/2", KernelFamily::Matern12},
                               {"matern-3/2", KernelFamily::Matern32},
                               {"matern-5/2", KernelFamily::Matern52},
                               {"periodic", KernelFamily::Periodic}},
                              &Field::kernel, &KernelModel::family),
      Key::to("field.length_mm", kMillimetres, &Field::kernel, &KernelModel::length_m),
      Key::to("field.signal_sd", kAsIs, &Field::kernel, &KernelModel::signal_sd),
      Key::to("field.noise", kAsIs, &Field::noise, &NoiseModel::sd),
      Key::to("field.length_prior_mm", kMillimetres, &Field::kernel, &KernelModel::length_median_m),
      Key::if_any("field.period_mm", kMillimetres, &Field::kernel, &KernelModel::period_m),
      Key::to("field.standardize", kAsIs, &Field::standardize),
      trend_key(),
      constant_key(),
      Key::word<bool>("field.precision", {{"double", false}, {"single", true}}, &Field::economy,
                      &Economy::single_precision),
      Key::to("field.reduced_rank", kAsIs, &Field::economy, &Economy::reduced_rank_tolerance),
      Key::to("field.rebuild_gain", kAsIs, &Field::economy, &Economy::rebuild_gain),
      Key::to("field.indenter_radius_mm", kMillimetres, &Field::probe,
              &ProbeModel::indenter_radius_m),
      Key::to("field.screening", kAsIs, &Field::probe, &ProbeModel::screening),
      Key::to("field.lag_mm", kMillimetres, &Field::probe, &ProbeModel::lag_m),
  };
  return keys;
}

const BoundKeys<Model>& model_keys() {
  using Key = Bind<Model>;
  static const BoundKeys<Model> keys = {
      Key::word<std::optional<ReadingScale>>(
          "field.transform",
          {{"none", ReadingScale::Raw}, {"log", ReadingScale::Log}, {"auto", std::nullopt}},
          &Model::contrast, &Contrast::scale),
      Key::to("level.fraction", kAsIs, &Model::level, &LevelRule::fraction),
      Key::to("level.value", kAsIs, &Model::level, &LevelRule::known),
      estimate_key(),
      Key::to("plan.min_contrast", kAsIs, &Model::contrast, &Contrast::least),
      Key::to("plan.safe_start", kAsIs, &Model::contrast, &Contrast::safe_start),
  };
  return keys;
}

const BoundKeys<Plan>& plan_keys() {
  using Key = Bind<Plan>;
  static const BoundKeys<Plan> keys = {
      Key::word<Design>("plan.initial.design",
                        {{"grid", Design::Grid},
                         {"random", Design::Random},
                         {"low-discrepancy", Design::LowDiscrepancy}},
                        &Plan::initial, &InitialDesign::design),
      Key::to("plan.initial.count", kAsIs, &Plan::initial, &InitialDesign::count),
      Key::to("seed", kAsIs, &Plan::initial, &InitialDesign::seed),
      Key::to("plan.batch", kAsIs, &Plan::batch, &BatchOptions::size),
      Key::to("plan.batches", kAsIs, &Plan::batches),
      Key::to("plan.least_spacing_mm", kMillimetres, &Plan::batch, &BatchOptions::least_spacing_m),
      way_key(),
      Key::to("plan.edge_share", kAsIs, &Plan::aim, &Aim::edge_share),
      Key::if_any("plan.goal.max_undetected_diameter_mm", kMillimetres, &Plan::aim,
                  &Aim::undetected_diameter_m),
      Key::to("plan.goal.probability", kAsIs, &Plan::aim, &Aim::probability),
      Key::to("plan.stop.expected_error_mm2", kSquareMillimetres, &Plan::stop, &StopRule::error_m2),
      Key::to("plan.stop.band_mm", kMillimetres, &Plan::stop, &StopRule::band_m),
      Key::to("plan.stop.least_gain", kAsIs, &Plan::stop, &StopRule::least_gain),
  };
  return keys;
}

const BoundKeys<Robot>& robot_keys() {
  using Key = Bind<Robot>;
  static const BoundKeys<Robot> keys = {
      Key::to("robot.from_tissue", kAsIs, &Robot::from_tissue),
      Key::to("robot.standoff_mm", kMillimetres, &Robot::standoff_m),
      Key::to("robot.indent_mm", kMillimetres, &Robot::indent_m),
      Key::to("robot.spring_n_per_m", kAsIs, &Robot::spring_n_per_m),
  };
  return keys;
}

const BoundKeys<Access>& access_keys() {
  using Key = Bind<Access>;
  static const BoundKeys<Access> keys = {
      Key::to("robot.cone_deg", kDegrees, &Access::cone_rad),
      Key::to("robot.clearance_mm", kMillimetres, &Access::clearance_m),
      Key::to("robot.probe_radius_mm", kMillimetres, &Access::probe_radius_m),
  };
  return keys;
}

const BoundKeys<GateLimits>& limit_keys() {
  using Key = Bind<GateLimits>;
  constexpr auto kForce = &GateLimits::force;
  constexpr auto kMotion = &GateLimits::motion;
  static const BoundKeys<GateLimits> keys = {
      Key::to("robot.limits.contact_n", kAsIs, kForce, &ForceLimits::contact_n),
      Key::to("robot.limits.warn_n", kAsIs, kForce, &ForceLimits::warn_n),
      Key::to("robot.limits.hold_n", kAsIs, kForce, &ForceLimits::hold_n),
      Key::to("robot.limits.stiffest_n_per_mm", kNewtonsPerMillimetre, kForce,
              &ForceLimits::stiffest_n_per_m),
      Key::to("robot.limits.frozen_ms", kMilliseconds, kForce, &ForceLimits::frozen_s),
      Key::to("robot.limits.air_mm_per_s", kMillimetres, kMotion, &MotionLimits::air_m_per_s),
      Key::to("robot.limits.contact_mm_per_s", kMillimetres, kMotion,
              &MotionLimits::contact_m_per_s),
      Key::to("robot.limits.step_mm", kMillimetres, kMotion, &MotionLimits::step_m),
      Key::to("robot.limits.astray_mm", kMillimetres, kMotion, &MotionLimits::astray_m),
      Key::to("robot.limits.extra_indent_mm", kMillimetres, &GateLimits::extra_indent_m),
      Key::to("robot.limits.cone_deg", kDegrees, &GateLimits::cone, &ApproachCone::axis_rad),
      Key::to("robot.limits.data_age_ms", kMilliseconds, &GateLimits::data_age_s),
      Key::to("robot.uncertainty_mm", kMillimetres, &GateLimits::uncertainty_m),
      Key::to("robot.frame", kAsIs, &GateLimits::frame),
  };
  return keys;
}

const BoundKeys<StiffnessModel>& stiffness_keys() {
  using Key = Bind<StiffnessModel>;
  static const BoundKeys<StiffnessModel> keys = {
      Key::to("probe.low", kAsIs, &StiffnessModel::low),
      Key::to("probe.high", kAsIs, &StiffnessModel::high),
      Key::to("probe.slope_per_m", kAsIs, &StiffnessModel::slope_per_m),
      Key::to("probe.noise", kAsIs, &StiffnessModel::noise),
      Key::to("probe.bias", kAsIs, &StiffnessModel::bias),
      Key::to("probe.lag_mm", kMillimetres, &StiffnessModel::lag_m),
  };
  return keys;
}

std::optional<FromMember> from_member(const std::string& path) {
  static const std::map<std::string, FromMember> members = [] {
    std::map<std::string, FromMember> all;
    const auto note = [&]<typename Options>(const BoundKeys<Options>& keys) {
      for (const BoundKey<Options>& key : keys) all[key.path] = {key.told(Options{}), key.words};
    };
    note(field_keys());
    note(model_keys());
    note(plan_keys());
    note(robot_keys());
    note(access_keys());
    note(limit_keys());
    note(stiffness_keys());
    return all;
  }();
  const auto found = members.find(path);
  return found == members.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace palpation::tool
