#pragma once
// Holds the handle in place when a simulated hand begins to hold it in contact. A hand without deflection would be pushed
// back by the force of the contact, and the robot with it; a person braces. The target of the hand is therefore displaced
// by -F/k, the deflection at which a hand of stiffness k bears the force F of the contact, also while F grows after an
// engagement. When the hand has moved by itself, the displacement only decreases with the force, so that it is zero
// without contact. One instance handles the position (m, N), and another one handles the rotation vector (rad, N m).

#include "common/spatial/spatial.hpp"

namespace longreach {

class HandBrace {
 public:
  /// `least`: displacement of the target by which a hand moves by itself, m or rad.
  explicit HandBrace(double least) : least_(least) {}

  /// The hand begins with its next target.
  void begin() { begins_ = true; }
  /// Returns the displacement of the target. `stiffness` is that of the hand; 0: the handle is released. `force`: contact
  /// force on the hand.
  Vector3 step(const Vector3& target, const Vector3& force, double stiffness) {
    if (!(stiffness > 0.0)) return displacement_ = Vector3::Zero();
    if (begins_) from_ = target;
    braces_ = (begins_ || braces_) && norm(target - from_) < least_;
    begins_ = false;
    const Vector3 bearing = -force / stiffness;
    return displacement_ = braces_ ? bearing : clamp_norm(displacement_, norm(bearing));
  }

 private:
  double least_;
  bool begins_ = true, braces_ = false;
  Vector3 from_ = Vector3::Zero();  // target when the hand began
  Vector3 displacement_ = Vector3::Zero();
};

}  // namespace longreach
