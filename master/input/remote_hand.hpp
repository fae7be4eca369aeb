#pragma once
// A hand controlled by messages of a remote client: it holds the handle while they arrive. If the messages
// stop for kHandAgeMax_s without a release, the handle is released and the robot holds; an orderly release
// only releases the handle. In both cases the handle stays released until the next engagement, so that no
// script or keyboard continues from there.
//
// The handle moves at most at the speed of a hand. Aims are relative to its position when it is taken, so
// that taking and returning it cause no motion.

#include <cstdint>
#include <optional>

#include "common/core/time.hpp"
#include "master/devices/hand_target.hpp"
#include "master/master_node.hpp"

namespace longreach {

/// Maximum age of the data of a hand: local hands are polled at 50 Hz, remote ones send at their own rate.
inline constexpr double kHandAgeMax_s = 0.3;

/// The newest message of the hand.
struct RemoteAim {
  Vector3 position_m = Vector3::Zero();    // from handle home, M
  Vector3 rotation_rad = Vector3::Zero();  // rotation vector from home
  bool clutch = false;
  bool grip = false;
  bool holds = false;  // false: there is no hand, or it has released the handle
  Time said{};
};

struct RemoteHandInput {
  Time now{};
  RemoteAim aim{};
  HandleState handle{};
  std::uint32_t engagement = 0;
  Grip grip = Grip::kLight;  // grip of a hand that holds
};

class RemoteHand {
 public:
  static constexpr double kSpeed_m_per_s = 0.2;
  static constexpr double kSpeed_rad_per_s = 1.5;

  explicit RemoteHand(double period_s) : period_s_(period_s) {}

  /// Returns none if the configured operator has the handle. Adds the requests of the hand to `requests`.
  std::optional<HandTarget> step(const RemoteHandInput& in, OperatorRequests& requests);

  [[nodiscard]] bool holds() const { return holds_; }
  /// In this tick, without an orderly release.
  [[nodiscard]] bool fell_silent() const { return fell_silent_; }

 private:
  void take(const RemoteHandInput& in);
  HandTarget lead(const RemoteHandInput& in);

  double period_s_;
  bool holds_ = false;
  bool fell_silent_ = false;
  bool gone_ = false;             // it held the handle, and no hand has held it since
  std::uint32_t engagement_ = 0;  // engagement at that time
  bool gripped_ = false;
  Vector3 led_m_ = Vector3::Zero();  // its position
  Vector3 led_rad_ = Vector3::Zero();
  Vector3 from_m_ = Vector3::Zero();  // offset added to aims
  Vector3 from_rad_ = Vector3::Zero();
};

}  // namespace longreach
