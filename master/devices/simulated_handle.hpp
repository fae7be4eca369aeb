#pragma once
// A simulated pair of haptic devices held by a simulated hand: a translational and a rotational mass.
//
//   (m + m_hand) x'' = F_motor - b x' + k_hand (x_hand - x) + b_hand (x_hand' - x') + edge
//
// Motor force is held between writes; the workspace edge is a stiff damped sphere. Integrated by
// semi-implicit Euler in steps of 50 us at most. Encoders are quantised; velocity is their filtered
// difference, as in a real device.

#include "master/devices/device_config.hpp"
#include "master/devices/haptic_device.hpp"

namespace longreach {

/// Where the person wants the handle to be.
struct HandTarget {
  Vector3 position_m = Vector3::Zero();  // in M, from home
  Vector3 velocity_m_per_s = Vector3::Zero();
  Vector3 rotation_rad = Vector3::Zero();  // rotation vector from home
  Grip grip = Grip::kLight;
};

/// Passive model of a hand at the translational handle.
struct HandModel {
  double mass_kg = 0.0;
  double damping_n_s_per_m = 0.0;
  double stiffness_n_per_m = 0.0;
};
HandModel hand_model(Grip grip);

class SimulatedHandle : public HapticDevice {
 public:
  explicit SimulatedHandle(const DeviceConfig& config) : config_(config) {}

  void set_target(const HandTarget& target) { target_ = target; }

  HandleState read(Time now) override;
  void write(const Wrench& F_H_M) override;

  [[nodiscard]] const Vector3& true_position_m() const { return x_; }
  [[nodiscard]] const Vector3& true_velocity_m_per_s() const { return v_; }

 private:
  void move(double dt_s);
  void turn(double dt_s);
  void measure(double dt_s);

  DeviceConfig config_;
  HandTarget target_{};
  Vector3 hand_m_ = Vector3::Zero();  // the target, moved on at its velocity between updates
  Wrench motor_{};
  Vector3 x_ = Vector3::Zero();
  Vector3 v_ = Vector3::Zero();
  Quaternion q_ = Quaternion::Identity();
  Vector3 omega_ = Vector3::Zero();
  HandleState measured_{};
  Time now_{};
  bool started_ = false;
};

}  // namespace longreach
