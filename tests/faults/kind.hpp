#pragma once
// A kind of fault: what it does to a world while it lasts. A row of a table; the tables are in the files
// *_kinds.cpp, one a group. Each function is called once a tick, in the order of the tick.

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

/// What a fault makes untrue while it lasts, or what else it disturbs: the oracle must know.
enum class AffectedSignal : std::uint16_t {
  kSensor = 1,       // the force that the slave is told
  kJoints = 2,       // the joints that the slave is told
  kRobot = 4,        // the robot does not do what it is asked for
  kHandle = 8,       // the handle that the master is told
  kLink = 16,        // datagrams come late or not at all
  kSlaveTime = 32,   // the slave does not run when it should
  kMasterTime = 64,  // likewise
  kScene = 128,      // what is touched changes by itself
  kMaster = 256,     // the master sends what no master should
  kSlave = 512,      // the slave does
  kOperator = 1024,  // the operator does not let it go on
  kLease = 2048      // who has the robot changes
};
constexpr std::uint16_t operator|(AffectedSignal a, AffectedSignal b) {
  return static_cast<std::uint16_t>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

constexpr std::uint16_t only(AffectedSignal a) { return static_cast<std::uint16_t>(a); }

/// A fault that is there now.
struct Active {
  Fault fault;
  Random random;
  double age_s = 0.0;  // since it began
  bool begins = true;  // in this tick
  // What it remembers.
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
  double besides =
      0.0;  // share of the seeds that have it once besides those they draw; 0: it is one of those
  void (*act)(World&, Active&) = nullptr;  // before the tick
  void (*end)(World&, Active&) = nullptr;  // when it is over
  void (*robot)(World&, Active&, RobotState&) = nullptr;
  void (*slave)(World&, Active&, SlaveInput&) = nullptr;
  void (*setpoint)(World&, Active&, JointVector&) = nullptr;
  void (*report)(World&, Active&, SlaveOutput&) = nullptr;
  void (*handle)(World&, Active&, HandleState&) = nullptr;
  void (*command)(World&, Active&, MasterOutput&) = nullptr;
};

/// `size` 0 to 1 on a logarithmic scale from `low` to `high`.
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

/// All of them, in the order of the groups.
const std::vector<FaultKind>& fault_kinds();
/// Its place in fault_kinds(). Throws ConfigError for a kind that is none.
std::size_t fault_kind(std::string_view name);

}  // namespace longreach
