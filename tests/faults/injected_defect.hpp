#pragma once
// Controls: a product in which a guard is missing or a limit does not hold, made by lying to it, or about it,
// at its boundary and behind the oracle's back. The campaign must find each of them.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "deploy/lab/fault_hooks.hpp"

namespace longreach {

enum class InjectedDefect : std::uint8_t {
  kNone,
  kSilenceUnnoticed,     // the slave thinks that it has just heard the master
  kRequestsNotReceived,  // holds and stops become requests to go on
  kStopNotReceived,      // a stop at the slave does not reach its node
  kForceNotRendered,     // the force sensor tells nothing
  kForgeriesTaken,       // a command that nobody sent is among those taken
  kLimitsFree,           // clients may loosen everything
  kSetpointsShake,       // beyond the joints' limits
  kPictureFrozen,        // the picture is that of the first moment
  kHandPushed,           // by ten times what was rendered
  kCauseWrong,           // each hold is said to be another master's
  kContactUnreported,    // nor what holds the robot back
  kRefusalUnreported,    // why an engagement is not granted is not told
  kTouchedEarly,         // surfaces are reported nearer than they are, and as touched for ever
  kCount
};

struct DefectFacts {
  std::string_view name;
  std::string_view invariant;  // that must see it
  std::string_view fault{};    // that brings it out
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

/// What is done to a side in a tick; remembers what it needs.
class DefectInjector {
 public:
  explicit DefectInjector(InjectedDefect what) : what_(what) {}

  [[nodiscard]] bool frees_limits() const { return what_ == InjectedDefect::kLimitsFree; }
  void apply(RobotState& reported) const;
  void before_sent_log(SlaveInput& input);  // what the ghost sees, too
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
