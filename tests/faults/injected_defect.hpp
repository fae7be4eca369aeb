#pragma once
// Controls: a product in which a guard is missing or a limit does not hold. This is simulated by falsifying
// data at its boundary, without the knowledge of the oracle. The campaign must find each of them.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "deploy/lab/fault_hooks.hpp"

namespace longreach {

enum class InjectedDefect : std::uint8_t {
  kNone,
  kSilenceUnnoticed,     // the slave assumes that it has just received the master
  kRequestsNotReceived,  // requests for hold and stop are removed
  kStopNotReceived,      // a stop at the slave does not reach its node
  kForceNotRendered,     // the force sensor reports zero
  kForgeriesTaken,       // a command that was never sent is accepted
  kLimitsFree,           // clients may loosen all limits
  kSetpointsShake,       // beyond the limits of the joints
  kPictureFrozen,        // the display shows the first tick for ever
  kHandPushed,           // with ten times the rendered force
  kCauseWrong,           // the cause of each hold is reported as preempted
  kContactUnreported,    // contacts, and what limits the robot, are not reported
  kRefusalUnreported,    // the reason why an engagement is not granted is missing
  kTouchedEarly,         // surfaces are reported too near, and always as touched
  kCount
};

struct DefectFacts {
  std::string_view name;
  std::string_view invariant;  // the invariant that must detect it
  std::string_view fault{};    // a fault that makes it visible
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
    {"touched early", "I32"},
}};

/// Applies the defect to a side in a tick, with its state.
class DefectInjector {
 public:
  explicit DefectInjector(InjectedDefect what) : what_(what) {}

  [[nodiscard]] bool frees_limits() const { return what_ == InjectedDefect::kLimitsFree; }
  void apply(RobotState& reported) const;
  void before_sent_log(SlaveInput& input);  // before the sent log records it
  void ask(SlaveInput& input);
  void answer(SlaveOutput& out);
  void answer(MasterOutput& out) const;

 private:
  InjectedDefect what_;
  std::vector<Received<MotionCommand>> commands_;
  std::uint64_t ticks_ = 0;
  std::optional<Pose> first_{};
  std::optional<ContactReport> touched_{};
};

}  // namespace longreach
