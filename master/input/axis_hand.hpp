#pragma once
// Converts the deflections and buttons of a gamepad, joystick or SpaceMouse to motion of the simulated hand.
// Pure.
//   s = (|d| - z)/(1 - z) d/|d| beyond the dead zone z, of push and twist each
//    rate mode       the hand is at reach s; when released, the handle is home and the robot is at rest
//    position mode   the hand moves with speed s; when released, it stays in place
// After a reconnection nothing acts until every axis has been released once; its buttons act when pressed. A
// deflection without a new report for silence_s counts as released, because a wireless receiver stays
// connected when its pad is gone.

#include <cstdint>

#include "master/input/hand_level.hpp"
#include "master/master_node.hpp"

namespace longreach {

/// Bits of AxisSample::buttons.
enum class PadButton : std::uint8_t { kMode, kScaleUp, kScaleDown, kClutch, kGripper, kEngage, kStop, kHome };

/// Present state of the device.
struct AxisSample {
  bool present = false;            // it is plugged in
  Vector3 push = Vector3::Zero();  // -1 to 1 along x, y, z of M
  Vector3 twist = Vector3::Zero();
  std::uint32_t buttons = 0;  // pressed buttons
  std::uint32_t reports = 0;  // number of reports of the device so far: motion of the axes

  void press(PadButton button, bool down) {
    if (down) buttons |= 1U << static_cast<unsigned>(button);
  }
};

struct AxisHandConfig {
  double dead_zone = 0.12;
  double reach_m = 0.04, reach_rad = 0.4;
  double speed_m_per_s = 0.03, speed_rad_per_s = 0.4;
  double workspace_m = 0.075, workspace_rad = 0.8;  // limits of the motion of the hand
  // A hand is never perfectly still, so that a held device reports continuously; but a stick at its end stop
  // gives constant values.
  double silence_s = 0.3, silence_at_stop_s = 1.0;
};
AxisHandConfig axis_hand_config(const OperatorConfig& config, const DeviceConfig& device);

struct AxisHandState {
  HandLevel level{.present = false};
  OperatorRequests requests{};  // since the last step; the clutch is in `level`
  bool armed = false;           // every axis was released since the device was connected
  bool silent = false;          // deflected without a new report for silence_s
};

class AxisHand {
 public:
  explicit AxisHand(const AxisHandConfig& config) : config_(config) {}

  /// `dt_s`: since the last step.
  const AxisHandState& step(const AxisSample& sample, MotionMode mode, double dt_s);

 private:
  void move(const AxisSample& sample, MotionMode mode, double dt_s);
  [[nodiscard]] bool silent(const AxisSample& sample, double dt_s);
  void take_buttons(std::uint32_t buttons, MotionMode mode);

  AxisHandConfig config_;
  AxisHandState state_{};
  std::uint32_t buttons_ = 0;  // in the last step
  std::uint32_t reports_ = 0;  // likewise
  double quiet_s_ = 0.0;       // since the last report
};

}  // namespace longreach
