#pragma once
// The simulated pair of haptic devices with a simulated hand on both: a DELTA for the position, and a 3-RRR
// spherical device for the orientation, if the device turns. As with real devices, the controller uses only the encoder
// angles.

#include "master/devices/delta/delta_handle.hpp"
#include "master/devices/hand_target.hpp"
#include "master/devices/haptic_device.hpp"
#include "master/devices/quantized_motion_filter.hpp"
#include "master/devices/spherical/spherical_handle.hpp"
#include "master/simulation/simulated_delta.hpp"
#include "master/simulation/simulated_spherical.hpp"

namespace longreach {

class SimulatedDevices : public HapticDevice {
 public:
  /// Throws GeometryError, which names the parameter, for an impossible device.
  explicit SimulatedDevices(const DeviceConfig& config);

  /// Sets the target of the simulated hand.
  void set_target(const HandTarget& target) { target_ = target; }

  HandleState read(Time now) override;
  void write(const Wrench& F_H_M) override;

  /// Places both handles at a pose, at rest. Call this before the first read. Returns false if a device
  /// cannot reach the pose.
  bool place(const Pose& X_MH);

  [[nodiscard]] const SimulatedDelta& delta() const { return delta_; }
  [[nodiscard]] const SimulatedSpherical& spherical() const { return spherical_; }

 private:
  bool turns_;
  SimulatedDelta delta_;
  SimulatedSpherical spherical_;
  DeltaHandle delta_handle_;
  SphericalHandle spherical_handle_;
  HandTarget target_{};
  HandleState measured_{};
  Time now_{};
  bool started_ = false;
};

/// Worst-case properties of a device over its workspace (27 points in a ball).
struct DeviceFigures {
  double mass_kg = 0.0;            // apparent mass of the handle with the moving parts
  double damping_n_s_per_m = 0.0;  // physical damping
  double inertia_kg_m2 = 0.0;
  double damping_nm_s_per_rad = 0.0;
  double delay_s = 0.0;  // from reading to motor torque: delayed samples and the lag of the motors
  EncoderCell cell{};
};
/// Returns half of the maximum displacement of the handle when each axis moves by `step_rad` or not at all, m
/// or rad. `rates` maps the velocity of the handle to the axis rates.
double cell_radius(double step_rad, const Matrix3& rates);
/// Returns the properties of a device with the sampling period `period_s`. Throws GeometryError like
/// SimulatedDevices.
DeviceFigures device_figures(const DeviceConfig& config, double period_s);

}  // namespace longreach
