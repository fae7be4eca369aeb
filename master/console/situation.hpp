#pragma once
// The situations of a session: what the operator needs to know. Terminal, page, status, log and summary show the same
// situation, which this file derives from the state of the master and the last report of the slave.
//
// A situation has a key, which scripts can wait for, and a sentence with the values of the moment. The sentence states
// who moves, how hard the hand and the tool press in a contact, and how old the statement about the robot is if that
// exceeds 0.1 s. SituationWatch (situation_watch.hpp) chooses the situation.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace longreach {

struct ConsoleSnapshot;

enum class Situation : std::uint8_t {
  kConnecting,
  kReady,
  kEngaging,
  kRefused,
  kFree,
  kSlow,
  kAtLimit,
  kClutch,
  kReleased,
  kBringHome,
  kMeasuring,
  kTouching,
  kFeltLess,
  kGuarded,
  kPushedBack,
  kUnsteady,
  kLeaving,
  kRemembered,
  kHolding,
  kSilent,
  kRecovered,
  kRestarted,
  kStopped,
  kFault,
  kCount
};

struct SituationText {
  std::string_view key;
  std::string_view meaning;
  std::string_view action;  // what the operator can do
};
const SituationText& text_of(Situation situation);
/// Returns whether the robot follows the hand in this situation.
bool is_motion(Situation situation);

/// What is shown to the operator.
struct Shown {
  Situation situation = Situation::kConnecting;
  std::string sentence{};             // without full stop
  std::vector<std::string> limits{};  // active limits of both sides with their reasons
};

/// What the present values alone do not show about a contact.
struct ContactCourse {
  double pushed_m = 0.0;  // distance by which a surface has pushed the robot back; 0: it does not
  bool unsteady = false;  // the force swings faster than the stiffness can be identified
};

/// Returns the situation of the moment.
Situation situation_of(const ConsoleSnapshot& snapshot, const ContactCourse& course = {});
/// Returns the sentence for `situation` with the values of the moment.
std::string sentence_of(Situation situation, const ConsoleSnapshot& snapshot,
                        const ContactCourse& course = {});

}  // namespace longreach
