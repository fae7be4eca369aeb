#pragma once
// The simulated pair of haptic devices with a simulated hand on both: a DELTA for the position, a 3-RRR
// spherical device for the orientation. The controller uses only the encoder angles, as with real devices.

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

  void set_target(const HandTarget& target) { target_ = target; }

  HandleState read(Time now) override;
  void write(const Wrench& F_H_M) override;

  /// Puts both handles at rest at a pose, before the first read. Returns false if a device cannot reach it.
  bool place(const Pose& X_MH);

  [[nodiscard]] const SimulatedDelta& delta() const { return delta_; }
  [[nodiscard]] const SimulatedSpherical& spherical() const { return spherical_; }

 private:
  SimulatedDelta delta_;
  SimulatedSpherical spherical_;
  DeltaHandle delta_handle_;
  SphericalHandle spherical_handle_;
  HandTarget target_{};
  HandleState measured_{};
  Time now_{};
  bool started_ = false;
};

/// Worst-case properties of a device in its workspace (27 points of the ball).
struct DeviceFigures {
  double mass_kg = 0.0;            // of the handle with the moving parts
  double damping_n_s_per_m = 0.0;  // physical
  double inertia_kg_m2 = 0.0;
  double damping_nm_s_per_rad = 0.0;
  double delay_s = 0.0;  // from read to motor torque: waiting samples and the motors' lag
  EncoderCell cell{};
};
/// Half of the maximum motion of the handle when each axis moves by `step_rad` or not at all; `rates`: of the
/// axes by the handle.
double cell_radius(double step_rad, const Matrix3& rates);
/// Throws GeometryError like SimulatedDevices.
DeviceFigures device_figures(const DeviceConfig& config, double period_s);

}  // namespace longreach
