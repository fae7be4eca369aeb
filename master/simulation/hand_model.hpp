#pragma once
// A passive model of the hand on the handle: a mass that moves with the handle, coupled by a spring and
// damper to the position that the person intends. The parameters for translation represent a light and a firm
// grip, from measurements on people. The parameters for rotation are assumed: the wrist and the handle have
// stiffnesses of the same order.

#include "schema/config_master.hpp"

namespace longreach {

struct HandModel {
  double mass_kg = 0.0;
  double damping_n_s_per_m = 0.0;
  double stiffness_n_per_m = 0.0;
};

struct WristModel {
  double damping_nm_s_per_rad = 0.0;
  double stiffness_nm_per_rad = 0.0;
};

/// Returns the translational model for a grip; all zero for a released handle.
constexpr HandModel hand_model(Grip grip) {
  if (grip == Grip::kReleased) return {};
  return grip == Grip::kFirm ? HandModel{1.7, 16.0, 400.0} : HandModel{0.55, 6.5, 135.0};
}

/// Returns the rotational model for a grip; all zero for a released handle.
constexpr WristModel wrist_model(Grip grip) {
  if (grip == Grip::kReleased) return {};
  return grip == Grip::kFirm ? WristModel{0.06, 1.8} : WristModel{0.02, 0.6};
}

}  // namespace longreach
