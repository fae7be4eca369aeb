// From the hand to the goal: scale, rotation and displacement of the handle at their ends.

#include <cmath>
#include <limits>
#include <numbers>

#include "common/config/config.hpp"
#include "common/core/random.hpp"
#include "common/text/number_text.hpp"
#include "deploy/lab/experiment.hpp"
#include "master/mapping/mapping.hpp"
#include "tests/extremes/extremes.hpp"

namespace longreach {
namespace {

constexpr double kExact = 1e-12;
constexpr double kTick_s = 1e-3;

/// The handle goes to `at` in a second; the goal there, to as much as the speed limits of the mapping allow.
Goal goal_at(const MappingConfig& config, MotionMode mode, double scale, const HandleState& at,
             double hold_s) {
  Mapping mapping(config);
  HandleState handle;
  handle.held = true;
  mapping.reset(handle);
  for (double t = 0.0; t < 1.0 + hold_s; t += kTick_s) {
    const double share = std::min(1.0, t);
    handle.p_MH = share * at.p_MH;
    handle.q_MH = exp_rotation(share * log_rotation(at.q_MH));
    mapping.step({.handle = handle, .mode = mode, .scale = scale}, kTick_s);
  }
  return mapping.goal();
}

/// `at_slave`: what the goal is judged by; another than `value` in the control.
ExtremeResult scale(double value, double at_slave) {
  const auto lab = configure({"mapping.scale=" + format_number(value)}, find_deploy_folder());
  const MappingConfig config = to_struct(lab.master()).mapping;
  HandleState at;
  at.p_MH = {0.03, -0.02, 0.01};
  const Goal goal = goal_at(config, MotionMode::kPosition, config.scale, at, 2.0);
  return accurate((goal.position_m - at_slave * at.p_MH).norm() / (at_slave * at.p_MH.norm()), kExact);
}

ExtremeResult turn(double angle_rad, std::uint64_t seed, double scale = 0.5) {
  Random random = Random(seed).child("extremes mapping");
  double worst = 0.0;
  for (int i = 0; i < 10; ++i) {
    const Vector3 axis = Vector3(random.normal(), random.normal(), random.normal()).stableNormalized();
    HandleState at;
    at.q_MH = exp_rotation(angle_rad * axis);
    const Goal goal = goal_at({}, MotionMode::kPosition, scale, at, 10.0);
    // At pi either way round is the shorter one.
    const Vector3 half_rad = 0.5 * log_rotation(at.q_MH);
    const double off =
        std::min(goal.rotation.angularDistance(exp_rotation(half_rad)),
                 angle_rad == std::numbers::pi ? goal.rotation.angularDistance(exp_rotation(-half_rad))
                                               : std::numbers::pi);
    worst = std::max({worst, std::abs(goal.rotation.norm() - 1.0), off});
  }
  return accurate(worst, 1e-7);  // angularDistance has half of the digits near zero
}

/// Where rate mode goes in the same time: speed kv (deflection - dead zone), at most as of the largest
/// radius.
double way_m(const MappingConfig& c, double x_m, double hold_s) {
  double way = 0.0;
  for (double t = 0.0; t < 1.0 + hold_s; t += kTick_s) {
    const double over_m = std::min(std::min(1.0, t) * x_m, c.radius_max_m) - c.dead_zone_m;
    way += kTick_s * std::min(c.kv_per_s * std::max(0.0, over_m), c.speed_max_m_per_s);
  }
  return way;
}

/// `gain`: of the speed that the goal is judged by; another than 1 in the control.
ExtremeResult deflection(double x_m, double gain = 1.0) {
  HandleState at;
  at.p_MH.x() = x_m;
  const MappingConfig config;
  const Goal goal = goal_at(config, MotionMode::kRate, 1.0, at, 10.0);
  if (!goal.position_m.allFinite()) return bad("a goal that is not finite");
  const Vector3 due_m(gain * way_m(config, x_m, 10.0), 0.0, 0.0);
  return accurate((goal.position_m - due_m).norm() / (11.0 * config.speed_max_m_per_s), kExact);
}

ExtremeResult not_a_number(double x_m) {
  Mapping mapping{MappingConfig{}};
  HandleState handle;
  handle.held = true;
  mapping.reset(handle);
  handle.p_MH.x() = 0.01;
  const Vector3 before = mapping.step({.handle = handle}, kTick_s).position_m;
  handle.p_MH.x() = x_m;
  const Vector3 after = mapping.step({.handle = handle}, kTick_s).position_m;
  return after == before ? refused("the goal stays") : bad("the goal moves");
}

}  // namespace

std::vector<ExtremeRow> extreme_mappings() {
  constexpr double kPi = std::numbers::pi, nan = std::numeric_limits<double>::quiet_NaN();
  const auto scaled = [](double value, const std::string& refusal) {
    return ExtremeCell{short_text(value), refusal, [value](std::uint64_t) { return scale(value, value); }};
  };
  const ExtremeRow scales{"mapping: scale",
                          "error of the goal",
                          {"0.2 for 0.21", "", [](std::uint64_t) { return scale(0.2, 0.21); }},
                          {scaled(1e-3, "outside 0.05 to 1"), scaled(0.05, ""), scaled(0.2, ""),
                           scaled(1.0, ""), scaled(1.05, "outside 0.05 to 1")}};
  ExtremeRow turns{"mapping: rotation of the handle",
                   "error of the goal, rad",
                   {"0.5 for 0.51", "", [](std::uint64_t seed) { return turn(1.0, seed, 0.51); }},
                   {}};
  const std::pair<const char*, double> angles[] = {{"0", 0.0}, {"1e-320", 1e-320},     {"1e-9", 1e-9},
                                                   {"1", 1.0}, {"π-1e-9", kPi - 1e-9}, {"π", kPi}};
  for (const auto& [name, angle] : angles)
    turns.cells.push_back({name, "", [angle = angle](std::uint64_t seed) { return turn(angle, seed); }});
  ExtremeRow rates{"mapping: deflection in rate mode",
                   "error of the goal / the longest way",
                   {"1 % slower", "", [](std::uint64_t) { return deflection(20.0, 0.99); }},
                   {}};
  for (const double x_m : {0.0, 1e-320, 1e-3, 0.01, 20.0, 1e300})
    rates.cells.push_back({short_text(x_m) + " m", "", [x_m](std::uint64_t) { return deflection(x_m); }});
  for (const double x_m : {nan, std::numeric_limits<double>::infinity()})
    rates.cells.push_back(
        {short_text(x_m), "the goal stays", [x_m](std::uint64_t) { return not_a_number(x_m); }});
  return {scales, turns, rates};
}

}  // namespace longreach
