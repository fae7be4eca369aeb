#pragma once
// Converts the deflections and buttons of a gamepad, joystick or SpaceMouse to motion of the simulated hand.
// Pure.
//   s = (|d| - z)/(1 - z) d/|d|  for a deflection d beyond the dead zone z, for push and twist separately
//    rate mode       the hand is displaced by reach · s; when released, it is at home and the robot is at rest
//    position mode   the hand moves at the velocity speed · s; when released, it stays in place
//
// After a reconnection, deflections have no effect until every axis has been released once; buttons act when
// they are pressed. A deflection without a new report for silence_s counts as released, because a wireless
// receiver stays connected even if its pad is switched off.

#include <array>
#include <cstdint>

#include "master/devices/button_press.hpp"
#include "master/input/hand_level.hpp"
#include "master/master_node.hpp"

namespace longreach {

/// Bit numbers in AxisSample::buttons.
enum class PadButton : std::uint8_t {
  kMode,
  kScaleUp,
  kScaleDown,
  kClutch,
  kGripper,
  kEngage,
  kStop,
  kHome,
  kKvUp,
  kKvDown
};
constexpr std::size_t kPadButtons = 10;

/// Current state of the device.
struct AxisSample {
  bool present = false;            // the device is plugged in
  Vector3 push = Vector3::Zero();  // -1 to 1 along x, y, z of M
  Vector3 twist = Vector3::Zero();
  std::uint32_t buttons = 0;  // bit mask of the pressed buttons
  std::uint32_t reports = 0;  // number of axis reports from the device so far

  void press(PadButton button, bool down) {
    if (down) buttons |= 1U << static_cast<unsigned>(button);
  }
};

struct AxisHandConfig {
  double dead_zone = 0.12;
  double reach_m = 0.04, reach_rad = 0.4;
  double speed_m_per_s = 0.03, speed_rad_per_s = 0.4;
  double workspace_m = 0.075, workspace_rad = 0.8;  // limits of the hand's motion
  // A hand is never perfectly still, so a device in use reports continuously. Only a stick at its end stop
  // gives constant values.
  double silence_s = 0.3, silence_at_stop_s = 1.0;
};
/// Returns the configuration for an operator and a device.
AxisHandConfig axis_hand_config(const OperatorConfig& config, const DeviceConfig& device);

struct AxisHandState {
  HandLevel level{.present = false};
  OperatorRequests requests{};  // requests since the last step; the clutch is in `level`
  bool armed = false;           // every axis has been released since the device was connected
  bool silent = false;          // the device is deflected, but has sent no report for silence_s
};

class AxisHand {
 public:
  explicit AxisHand(const AxisHandConfig& config) : config_(config) {}

  /// Advances by `dt_s`, the time since the last step, s.
  const AxisHandState& step(const AxisSample& sample, MotionMode mode, double dt_s);
  /// Makes the hand begin at this pose, relative to the handle's home. Deflections have no effect until every axis has been
  /// released.
  void begin_at(const Vector3& target_m, const Vector3& target_rad) {
    state_.level.target_m = target_m;
    state_.level.target_rad = target_rad;
    state_.armed = false;
  }

 private:
  void move(const AxisSample& sample, MotionMode mode, double dt_s);
  [[nodiscard]] bool silent(const AxisSample& sample, double dt_s);
  void take_buttons(std::uint32_t buttons, MotionMode mode, double dt_s);

  AxisHandConfig config_;
  AxisHandState state_{};
  std::array<ButtonPress, kPadButtons> buttons_{};
  std::uint32_t reports_ = 0;  // AxisSample::reports in the last step
  double quiet_s_ = 0.0;       // time since the last report
};

}  // namespace longreach
