// From the hand to the goal: scale, rotation and displacement of the handle at their ends.

#include <cmath>
#include <limits>
#include <numbers>

#include "common/config/config.hpp"
#include "common/config/number_text.hpp"
#include "common/core/random.hpp"
#include "master/mapping/mapping.hpp"
#include "tests/experiments/experiment.hpp"
#include "tests/experiments/extremes/extremes.hpp"

namespace longreach {
namespace {

constexpr double kExact = 1e-12;
constexpr double kPeriod_s = 1e-3;

/// The handle goes to `at` in a second; the goal there, to as much as the speed limits of the mapping allow.
Goal goal_at(const MappingConfig& config, MotionMode mode, double scale, const HandleState& at,
             double hold_s) {
  Mapping mapping(config);
  HandleState handle;
  handle.held = true;
  mapping.reset(handle);
  for (double t = 0.0; t < 1.0 + hold_s; t += kPeriod_s) {
    const double share = std::min(1.0, t);
    handle.p_MH = share * at.p_MH;
    handle.q_MH = exp_rotation(share * log_rotation(at.q_MH));
    mapping.step({.handle = handle, .mode = mode, .scale = scale}, kPeriod_s);
  }
  return mapping.goal();
}

ExtremeResult scale(double value) {
  const auto lab = configure({"mapping.scale=" + format_number(value)}, find_deploy_folder());
  const MappingConfig config = to_struct(lab.master()).mapping;
  HandleState at;
  at.p_MH = {0.03, -0.02, 0.01};
  const Goal goal = goal_at(config, MotionMode::kPosition, config.scale, at, 2.0);
  return accurate((goal.position_m - value * at.p_MH).norm() / (value * at.p_MH.norm()), kExact);
}

ExtremeResult turn(double angle_rad, std::uint64_t seed) {
  Random random = Random(seed).child("extremes mapping");
  double worst = 0.0;
  for (int i = 0; i < 10; ++i) {
    const Vector3 axis = Vector3(random.normal(), random.normal(), random.normal()).stableNormalized();
    HandleState at;
    at.q_MH = exp_rotation(angle_rad * axis);
    const Goal goal = goal_at({}, MotionMode::kPosition, 0.5, at, 10.0);
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

ExtremeResult deflection(double x_m) {
  HandleState at;
  at.p_MH.x() = x_m;
  const MappingConfig config;
  const Goal goal = goal_at(config, MotionMode::kRate, 1.0, at, 10.0);
  if (!goal.position_m.allFinite()) return bad("a goal that is not finite");
  return accurate(std::max(0.0, goal.position_m.norm() / (11.1 * config.speed_max_m_per_s) - 1.0), kExact);
}

ExtremeResult not_a_number(double x_m) {
  Mapping mapping{MappingConfig{}};
  HandleState handle;
  handle.held = true;
  mapping.reset(handle);
  handle.p_MH.x() = 0.01;
  const Vector3 before = mapping.step({.handle = handle}, kPeriod_s).position_m;
  handle.p_MH.x() = x_m;
  const Vector3 after = mapping.step({.handle = handle}, kPeriod_s).position_m;
  return after == before ? refused("the goal stays") : bad("the goal moves");
}

}  // namespace

std::vector<ExtremeRow> extreme_mappings() {
  constexpr double kPi = std::numbers::pi, nan = std::numeric_limits<double>::quiet_NaN();
  ExtremeRow scales{"mapping: scale", "error of the goal", {}};
  for (const double value : {1e-3, 0.05, 0.2, 1.0, 1.05})
    scales.cells.push_back({short_text(value), [value](std::uint64_t) { return scale(value); }});
  ExtremeRow turns{"mapping: rotation of the handle", "error of the goal, rad", {}};
  const std::pair<const char*, double> angles[] = {{"0", 0.0}, {"1e-320", 1e-320},     {"1e-9", 1e-9},
                                                   {"1", 1.0}, {"π-1e-9", kPi - 1e-9}, {"π", kPi}};
  for (const auto& [name, angle] : angles)
    turns.cells.push_back({name, [angle = angle](std::uint64_t seed) { return turn(angle, seed); }});
  ExtremeRow rates{"mapping: deflection in rate mode", "speed above its limit", {}};
  for (const double x_m : {0.0, 1e-320, 1e-3, 20.0, 1e300})
    rates.cells.push_back({short_text(x_m) + " m", [x_m](std::uint64_t) { return deflection(x_m); }});
  for (const double x_m : {nan, std::numeric_limits<double>::infinity()})
    rates.cells.push_back({short_text(x_m), [x_m](std::uint64_t) { return not_a_number(x_m); }});
  return {scales, turns, rates};
}

}  // namespace longreach
