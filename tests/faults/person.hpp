#pragma once
// The simulated operator of a run: moves the handle, presses on the wall, pauses, and requests an engagement
// whenever the display shows no active engagement. Between two positions the hand moves on minimum-jerk
// trajectories.

#include "common/core/random.hpp"
#include "master/devices/hand_target.hpp"
#include "master/master_node.hpp"

namespace longreach {

class Person {
 public:
  Person(Random random, const MasterConfig& master, double round_trip_s);

  /// Returns the target of the hand. A request to engage is added to `requests`.
  HandTarget step(double now_s, const MasterView& shown, OperatorRequests& requests);

  /// Keeps the hand at rest from now on.
  void rest() { resting_ = true; }
  [[nodiscard]] bool asked() const { return asked_; }  // an engagement was requested in this tick
  /// Makes the operator request an engagement again and again instead of waiting for a reply.
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
