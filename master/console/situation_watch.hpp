#pragma once
// Chooses the situation that is shown to the operator:
//
//   a fault or a stop begins                                   shown at once
//   the safety state changes, unless the robot may resume      shown when the last situation was shown for 0.5 s
//     automatically
//   the shown situation has not applied for 0.5 s              the one that applies now is shown
//
// A contact or limit that ends within 0.5 s is therefore not shown, and there are at most two changes per second.

#include <array>
#include <cstddef>
#include <vector>

#include "common/spatial/spatial.hpp"
#include "master/console/situation.hpp"

namespace longreach {

/// Observes the course of a contact.
class CourseWatch {
 public:
  ContactCourse step(const ConsoleSnapshot& snapshot);

 private:
  double pushed_m(const ConsoleSnapshot& snapshot);
  bool unsteady(const ConsoleSnapshot& snapshot);

  // Deepest points of tool (W) and hand (M) since the contact began.
  bool pressing_ = false;
  Vector3 tool_m_ = Vector3::Zero(), hand_m_ = Vector3::Zero();
  // The last extreme of the force at the tool, and the times of the last reversals.
  double extreme_n_ = 0.0;
  int direction_ = 0;
  static constexpr std::size_t kReversals = 4;
  std::array<double, kReversals> reversed_s_{};
  std::size_t reversals_ = 0;
};

class SituationWatch {
 public:
  /// `snapshot.seconds` is the time; it must not decrease. Its field `shown` is not read.
  Shown step(const ConsoleSnapshot& snapshot);

 private:
  void choose(const ConsoleSnapshot& snapshot, Situation now);
  std::vector<std::string> limits(const ConsoleSnapshot& snapshot);

  CourseWatch course_;
  bool begun_ = false;
  Situation shown_ = Situation::kConnecting;
  double shown_since_s_ = 0.0, applied_s_ = 0.0;
  /// A limit is listed from 0.5 s after its begin to 0.5 s after its end.
  struct Limit {
    bool listed = false;
    double same_s = 0.0;  // last time at which the flag was as listed
  };
  static constexpr std::size_t kLimits = 16;
  std::array<Limit, kLimits> limits_{};
};

}  // namespace longreach
