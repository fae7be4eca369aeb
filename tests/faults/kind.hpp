#pragma once
// Kinds of fault and their effects on a world while they are active. Each kind is one row of a table; the
// tables are in *_kinds.cpp, one table per group. The functions of a kind are called once per tick, in the
// order of the tick.

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/random.hpp"
#include "deploy/lab/fault_hooks.hpp"
#include "tests/faults/schedule.hpp"

namespace longreach {

class World;

/// Signals that a fault falsifies or disturbs while it is active. The oracle takes them into account.
enum class AffectedSignal : std::uint16_t {
  kSensor = 1,       // the force that the slave receives
  kJoints = 2,       // the joint positions that the slave receives
  kRobot = 4,        // the robot does not follow its setpoints
  kHandle = 8,       // the handle state that the master receives
  kLink = 16,        // datagrams arrive late or not at all
  kSlaveTime = 32,   // the slave runs late
  kMasterTime = 64,  // the master runs late
  kScene = 128,      // the touched object changes by itself
  kMaster = 256,     // the master sends messages that no master may send
  kSlave = 512,      // the slave sends messages that no slave may send
  kOperator = 1024,  // the operator prevents the engagement
  kLease = 2048      // another master takes control of the robot
};
constexpr std::uint16_t operator|(AffectedSignal a, AffectedSignal b) {
  return static_cast<std::uint16_t>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

constexpr std::uint16_t only(AffectedSignal a) { return static_cast<std::uint16_t>(a); }

/// An active fault.
struct Active {
  Fault fault;
  Random random;
  double age_s = 0.0;  // time since the start of the fault
  bool begins = true;  // true only in the first tick of the fault
  // State of the fault; each kind uses the members that it needs.
  RobotState robot{};
  HandleState handle{};
  Vector3 direction = Vector3::Zero();
  double level = 0.0;
  std::uint64_t count = 0;
  std::deque<JointVector> queue{};
};

struct FaultKind {
  std::string_view name;
  std::string_view group;
  std::uint16_t affects = 0;
  double longest_s = 5.0;
  double shortest_s = 0.005;
  /// Fraction of the seeds to which one fault of this kind is added; 0: the kind is drawn like the others.
  double besides = 0.0;
  void (*act)(World&, Active&) = nullptr;  // called before the tick
  void (*end)(World&, Active&) = nullptr;  // called when the fault ends
  void (*robot)(World&, Active&, RobotState&) = nullptr;
  void (*slave)(World&, Active&, SlaveInput&) = nullptr;
  void (*setpoint)(World&, Active&, JointVector&) = nullptr;
  void (*report)(World&, Active&, SlaveOutput&) = nullptr;
  void (*handle)(World&, Active&, HandleState&) = nullptr;
  void (*command)(World&, Active&, MasterOutput&) = nullptr;
};

/// Maps `size` in 0..1 to `low`..`high` on a logarithmic scale.
double log_scale(double size, double low, double high);

std::span<const FaultKind> datagram_kinds();
std::span<const FaultKind> link_kinds();
std::span<const FaultKind> time_kinds();
std::span<const FaultKind> value_kinds();
std::span<const FaultKind> operator_kinds();
std::span<const FaultKind> sensor_kinds();
std::span<const FaultKind> robot_kinds();
std::span<const FaultKind> device_kinds();
std::span<const FaultKind> contact_kinds();

/// All kinds, in the order of the groups.
const std::vector<FaultKind>& fault_kinds();
/// Returns the index of a kind in fault_kinds(). Throws ConfigError if the kind is unknown.
std::size_t fault_kind(std::string_view name);

}  // namespace longreach
