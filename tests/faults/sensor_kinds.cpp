// A force sensor that lies.

#include <algorithm>
#include <array>

#include "tests/faults/world.hpp"

namespace longreach {
namespace {

Vector3 any_direction(Random& random) {
  return Vector3(random.normal(), random.normal(), random.normal()).normalized();
}
const Vector3& direction(Active& fault) {
  if (fault.begins) fault.direction = any_direction(fault.random);
  return fault.direction;
}

void bias(World&, Active& fault, RobotState& reported) {
  reported.F_F_W.force += log_scale(fault.fault.size, 0.05, 30.0) * direction(fault);
}
void drift(World&, Active& fault, RobotState& reported) {
  reported.F_F_W.force += fault.age_s * log_scale(fault.fault.size, 0.05, 20.0) * direction(fault);
}
void stuck(World&, Active& fault, RobotState& reported) {
  reported.F_F_W.force = log_scale(fault.fault.size, 0.5, 60.0) * direction(fault);
}
void saturated(World&, Active& fault, RobotState& reported) {
  const double range = log_scale(fault.fault.size, 1.0, 20.0);
  reported.F_F_W.force = reported.F_F_W.force.cwiseMax(-range).cwiseMin(range);
}
void spike(World&, Active& fault, RobotState& reported) {
  constexpr std::array kSpikes = {30.0, 100.0, 1e3, 1e6, 1e30, 1e300};
  if (fault.begins || fault.random.chance(0.01))
    reported.F_F_W.force += kSpikes[fault.random.next() % kSpikes.size()] * any_direction(fault.random);
}
void wrong_sign(World&, Active&, RobotState& reported) {
  reported.F_F_W.force *= -1.0;
  reported.F_F_W.moment *= -1.0;
}
void twist(World&, Active& fault, RobotState& reported) {
  reported.F_F_W.moment += log_scale(fault.fault.size, 0.02, 4.0) * direction(fault);
}
/// As a wrong sign does on a wall: the force that it tells grows as the tool gives way to it.
void opposes(World& world, Active& fault, RobotState& reported) {
  const Vector3& along = direction(fault);
  const double guard_n = world.scenario().slave.command.force_guard_n;
  if (fault.begins) fault.level = along.dot(world.moment().X_WE.p);
  const double way_m = std::max(along.dot(world.moment().X_WE.p) - fault.level, 0.0);
  reported.F_F_W.force += (0.95 * guard_n + log_scale(fault.fault.size, 300.0, 1e4) * way_m) * along;
}
void wrong_frame(World&, Active& fault, RobotState& reported) {
  const Quaternion q = exp_rotation(fault.fault.size * 3.0 * direction(fault));
  reported.F_F_W = {q * reported.F_F_W.moment, q * reported.F_F_W.force};
}
void frozen(World&, Active& fault, RobotState& reported) {
  if (fault.begins) fault.robot = reported;
  reported.F_F_W = fault.robot.F_F_W;
}
/// A sensor whose adapter no longer reads it: exactly zero, in contact or not.
void zero(World&, Active&, RobotState& reported) { reported.F_F_W = {}; }
/// One dead channel of the six.
void dead_channel(World&, Active& fault, RobotState& reported) {
  const auto channel = static_cast<Eigen::Index>(fault.fault.seed % 6);
  (channel < 3 ? reported.F_F_W.force : reported.F_F_W.moment)[channel % 3] = 0.0;
}
void noisy(World&, Active& fault, RobotState& reported) {
  const double sd = log_scale(fault.fault.size, 0.1, 5.0);
  for (int i = 0; i < 3; ++i) reported.F_F_W.force[i] += sd * fault.random.normal();
}
/// A tool of another mass than the slave knows of: its weight, and what it takes to move it.
void wrong_mass(World& world, Active& fault, RobotState& reported) {
  const double kg = log_scale(fault.fault.size, 0.01, 3.0);
  const Vector3& v = world.moment().v_WE;
  if (fault.begins) fault.direction = v;
  const Vector3 a = (v - fault.direction) / world.moment().period_s;
  fault.direction = v;
  reported.F_F_W.force -= kg * a;
}

constexpr std::string_view kGroup = "force sensor";
constexpr auto kSensor = only(AffectedSignal::kSensor);

const FaultKind kKinds[] = {
    {.name = "sensor-biased", .group = kGroup, .affects = kSensor, .robot = bias},
    {.name = "sensor-drifts", .group = kGroup, .affects = kSensor, .robot = drift},
    {.name = "sensor-stuck", .group = kGroup, .affects = kSensor, .robot = stuck},
    {.name = "sensor-saturated", .group = kGroup, .affects = kSensor, .robot = saturated},
    {.name = "sensor-spikes", .group = kGroup, .affects = kSensor, .robot = spike},
    {.name = "sensor-sign", .group = kGroup, .affects = kSensor, .robot = wrong_sign},
    {.name = "sensor-opposes",
     .group = kGroup,
     .affects = kSensor,
     .longest_s = 6.0,
     .shortest_s = 2.0,
     .besides = 0.15,
     .robot = opposes},
    {.name = "moment-biased", .group = kGroup, .affects = kSensor, .besides = 0.15, .robot = twist},
    {.name = "sensor-frame", .group = kGroup, .affects = kSensor, .robot = wrong_frame},
    {.name = "sensor-frozen", .group = kGroup, .affects = kSensor, .robot = frozen},
    {.name = "sensor-zero",
     .group = kGroup,
     .affects = kSensor,
     .shortest_s = 0.5,
     .besides = 0.15,
     .robot = zero},
    {.name = "sensor-channel-dead", .group = kGroup, .affects = kSensor, .robot = dead_channel},
    {.name = "sensor-noisy", .group = kGroup, .affects = kSensor, .robot = noisy},
    {.name = "tool-mass-wrong", .group = kGroup, .affects = kSensor, .robot = wrong_mass},
};

}  // namespace

std::span<const FaultKind> sensor_kinds() { return kKinds; }

}  // namespace longreach
