#pragma once
// Control experiments with a product in which a guard is missing or a limit does not hold. Such a defect is
// simulated by falsifying data at the boundary of the product, where the oracle does not observe it. The
// campaign must detect each defect.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "common/core/random.hpp"
#include "deploy/lab/fault_hooks.hpp"

namespace longreach {

enum class InjectedDefect : std::uint8_t {
  kNone,
  kSilenceUnnoticed,     // the slave behaves as if a datagram had always just arrived
  kRequestsNotReceived,  // requests for a hold or a stop are removed
  kStopNotReceived,      // a stop that is requested at the slave does not reach its node
  kForceNotRendered,     // the force sensor reports its noise alone
  kForgeriesTaken,       // a command that was never sent is accepted
  kLimitsFree,           // clients may loosen all limits
  kSetpointsShake,       // setpoints oscillate beyond the limits of the joints
  kPictureFrozen,        // the display always shows the pose of the first tick
  kHandPushed,           // the hand receives ten times the rendered force
  kCauseWrong,           // the cause of each hold is reported as preempted
  kContactUnreported,    // contacts and active limits of the robot are not reported
  kRefusalUnreported,    // the reason why an engagement is not granted is missing
  kTakenNotReceived,     // the slave does not learn that another master has taken the robot
  kLatenessUnreported,   // late ticks of the slave are not counted
  kLossUnreported,       // the loss of commands is not measured
  kTouchedEarly,         // surfaces are reported too near and always as pressed
  kCount
};

struct DefectFacts {
  std::string_view name;
  std::string_view invariant;  // the invariant that must detect it
  std::string_view fault{};    // fault that makes the defect visible; empty if no fault is needed
};
constexpr std::array<DefectFacts, static_cast<std::size_t>(InjectedDefect::kCount)> kInjectedDefects = {{
    {"none", ""},
    {"silence unnoticed", "I11", "half-open-up"},
    {"requests unheard", "I11", "holds"},
    {"stop unheard", "I11", "stops-at-slave"},
    {"force unfelt", "I21"},
    {"forgeries taken", "I13-15"},
    {"limits free", "I20", "limits-loosened"},
    {"setpoints shake", "I5"},
    {"picture frozen", "I25"},
    {"hand pushed", "I22"},
    {"cause wrong", "I30", "half-open-up"},
    {"contact unreported", "I31"},
    {"refusal unreported", "I33", "joints-jump"},
    {"taking unheard", "I30", "robot-taken"},
    {"lateness unreported", "I38", "slave-frozen"},
    {"loss unreported", "I38", "loss"},
    {"touched early", "I32"},
}};

/// Applies the defect to the inputs and outputs of a side in each tick.
class DefectInjector {
 public:
  explicit DefectInjector(InjectedDefect what) : what_(what) {}

  [[nodiscard]] bool frees_limits() const { return what_ == InjectedDefect::kLimitsFree; }
  void apply(RobotState& reported);
  void before_sent_log(SlaveInput& input);  // called before the sent log records the input
  void ask(SlaveInput& input);
  void answer(SlaveOutput& out);
  void answer(MasterOutput& out) const;

 private:
  InjectedDefect what_;
  std::vector<Received<MotionCommand>> commands_;
  std::uint64_t ticks_ = 0;
  Random noise_{1};
  std::optional<Pose> first_{};
  std::optional<ContactReport> touched_{};
};

}  // namespace longreach
