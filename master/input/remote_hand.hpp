#pragma once
// A hand that a remote client controls with messages. It holds the handle while messages arrive. If the
// messages stop for kHandAgeMax_s without a release, the handle is released and the robot holds. After an explicit
// release, the robot does not hold, and a person at keyboard or pad has the handle back at once. Otherwise the handle
// stays released until the next engagement, so that no script resumes motion from there.
//
// The handle moves at most as fast as a human hand. Targets are relative to the position of the handle when
// the client took control, directly or from another client, or when an engagement began, so that neither causes
// motion.

#include <cstdint>
#include <optional>

#include "common/core/time.hpp"
#include "master/devices/hand_target.hpp"
#include "master/master_node.hpp"

namespace longreach {

/// Maximum age of the input from a hand. Local input devices are polled at 50 Hz; remote clients send at
/// their own rate.
inline constexpr double kHandAgeMax_s = 0.3;

/// The newest message from the remote client.
struct RemoteAim {
  Vector3 position_m = Vector3::Zero();    // target position, relative to the handle's home, M
  Vector3 rotation_rad = Vector3::Zero();  // target rotation vector, relative to the handle's home, M
  bool clutch = false;
  bool grip = false;
  std::uint64_t hand = 0;  // number of the client
  bool holds = false;      // false: no client holds the handle, or the client has released it
  Time said{};
};

struct RemoteHandInput {
  Time now{};
  RemoteAim aim{};
  HandleState handle{};
  std::uint32_t engagement = 0;
  Grip grip = Grip::kLight;  // grip while the hand holds the handle
  bool person = false;       // the configured operator is a person, who may take the handle back at once
};

class RemoteHand {
 public:
  static constexpr double kSpeed_m_per_s = 0.2;
  static constexpr double kSpeed_rad_per_s = 1.5;

  explicit RemoteHand(double period_s) : period_s_(period_s) {}

  /// Returns the target of the hand, or none if the configured operator controls the handle. Adds the
  /// requests of the remote client to `requests`.
  std::optional<HandTarget> step(const RemoteHandInput& in, OperatorRequests& requests);

  /// Returns whether a remote client holds the handle.
  [[nodiscard]] bool holds() const { return holds_; }
  /// Returns whether the messages stopped in this tick without a release.
  [[nodiscard]] bool fell_silent() const { return fell_silent_; }

 private:
  void take(const RemoteHandInput& in);
  HandTarget lead(const RemoteHandInput& in);

  double period_s_;
  bool holds_ = false;
  bool fell_silent_ = false;
  bool gone_ = false;             // the client has released the handle, and no hand has held it since
  std::uint32_t engagement_ = 0;  // engagement when the handle was taken or released
  bool gripped_ = false;
  std::uint64_t hand_ = 0;           // client that holds the handle
  Vector3 led_m_ = Vector3::Zero();  // current position of the hand, relative to home
  Vector3 led_rad_ = Vector3::Zero();
  Vector3 from_m_ = Vector3::Zero();  // offset added to targets
  Vector3 from_rad_ = Vector3::Zero();
};

}  // namespace longreach
