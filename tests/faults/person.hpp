#pragma once
// The operator of a run: wanders with the handles, presses where the wall is, rests, and asks to engage again
// whenever the screen shows that nothing is engaged. Between two places the hand moves with least jerk.

#include "common/core/random.hpp"
#include "master/devices/hand_target.hpp"
#include "master/master_node.hpp"

namespace longreach {

class Person {
 public:
  Person(Random random, const MasterConfig& master, double round_trip_s);

  /// What the hand wants now; a request to engage goes into `requests`.
  HandTarget step(double now_s, const MasterView& shown, OperatorRequests& requests);

  /// Nothing but a still hand, from now on.
  void rest() { resting_ = true; }
  [[nodiscard]] bool asked() const { return asked_; }  // in this tick
  /// Clicks on Engage again and again instead of waiting for an answer.
  void be_impatient(bool impatient) { impatient_ = impatient; }

 private:
  void choose(double now_s);
  [[nodiscard]] Vector3 anywhere(double reach);

  Random random_;
  Grip grip_;
  bool rate_;
  double reach_m_, reach_rad_, timeout_s_;
  double moves_at_s_ = 0.0, arrives_s_ = 0.0, chooses_s_ = 0.0;
  Vector3 from_m_ = Vector3::Zero(), to_m_ = Vector3::Zero();
  Vector3 from_rad_ = Vector3::Zero(), to_rad_ = Vector3::Zero();
  double ask_s_ = 1.0;
  bool resting_ = false, impatient_ = false, asked_ = false;
};

}  // namespace longreach
