#pragma once
// A hand that comes from outside by messages: it holds the handle while they come. A hand that falls silent
// for kHandAgeMax_s lets go, and the robot holds; one that lets go in order just lets go. Either way nobody
// holds the handle then until the next engagement, so that no script or keyboard goes on where a person
// stopped.
//
// The handle is led at no more than the speed of a hand. Aims count from where it is when it is taken: taking
// it, like giving it back, moves nothing.

#include <cstdint>
#include <optional>

#include "common/core/time.hpp"
#include "master/devices/hand_target.hpp"
#include "master/master_node.hpp"

namespace longreach {

/// How old what is known of a hand may be: hands here are asked at 50 Hz, those from outside tell by
/// themselves.
inline constexpr double kHandAgeMax_s = 0.3;

/// The newest message of the hand.
struct RemoteAim {
  Vector3 position_m = Vector3::Zero();    // from handle home, M
  Vector3 rotation_rad = Vector3::Zero();  // rotation vector from home
  bool clutch = false;
  bool grip = false;
  bool holds = false;  // false: nobody is there, or has let go
  Time said{};
};

struct RemoteHandInput {
  Time now{};
  RemoteAim aim{};
  HandleState handle{};
  std::uint32_t engagement = 0;
  Grip grip = Grip::kLight;  // of a hand that holds
};

class RemoteHand {
 public:
  static constexpr double kSpeed_m_per_s = 0.2;
  static constexpr double kSpeed_rad_per_s = 1.5;

  explicit RemoteHand(double period_s) : period_s_(period_s) {}

  /// None: the handle is the configured operator's. Adds to `requests` what the hand asks for.
  std::optional<HandTarget> step(const RemoteHandInput& in, OperatorRequests& requests);

  [[nodiscard]] bool holds() const { return holds_; }
  /// In this tick, without having let go.
  [[nodiscard]] bool fell_silent() const { return fell_silent_; }

 private:
  void take(const RemoteHandInput& in);
  HandTarget lead(const RemoteHandInput& in);

  double period_s_;
  bool holds_ = false;
  bool fell_silent_ = false;
  bool gone_ = false;             // it held the handle, and nobody has since
  std::uint32_t engagement_ = 0;  // when it went
  bool gripped_ = false;
  Vector3 led_m_ = Vector3::Zero();  // where it is
  Vector3 led_rad_ = Vector3::Zero();
  Vector3 from_m_ = Vector3::Zero();  // what is added to aims
  Vector3 from_rad_ = Vector3::Zero();
};

}  // namespace longreach
