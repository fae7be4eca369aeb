#pragma once
// The commands that an adapter check sends to a device or a robot, and the evaluation of their effect.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/link/adapter_datagram.hpp"
#include "deploy/cli/adapter/handle_findings.hpp"

namespace longreach {

inline std::string in_text(const char* format, double value) {
  char text[120];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// A haptic device. The check commands a small force along z, which the device must report.
class DeviceSubject {
 public:
  using Out = adapter::WrenchDatagram;
  using In = adapter::HandleDatagram;
  static constexpr const char* kWhat = "device";
  static constexpr const char* kSends = "HandleDatagram";
  static constexpr const char* kAsk = "wrench";
  static constexpr const char* kRests = "renders no wrench";
  static constexpr double kSettle_s = 0.2;

  DeviceSubject(double force_n, std::optional<DeviceConfig> device)
      : force_n_(force_n), device_(std::move(device)) {}

  void know(const In&) {}
  /// Evaluates the states that were reported while nothing was commanded.
  void watch(std::int64_t at_ns, const In& in) { seen_.push_back({at_ns, in}); }
  [[nodiscard]] std::vector<Finding> findings() const { return handle_findings(seen_, device_); }
  [[nodiscard]] Out ask(double /*t_s*/) const {
    Out out;
    out.flags = Out::kLive;
    out.force_n[2] = force_n_;
    return out;
  }
  /// The same command with an additional force along x. The adapter must ignore it.
  [[nodiscard]] Out poison(Out out) const {
    out.force_n[0] = 2.0 * force_n_;
    return out;
  }
  [[nodiscard]] Out nothing() const { return {}; }
  [[nodiscard]] bool does(const In& in) const {
    return std::abs(in.force_n[2] - force_n_) <= 0.01 * force_n_ &&
           std::abs(in.force_n[0]) <= 0.01 * force_n_ && std::abs(in.force_n[1]) <= 0.01 * force_n_;
  }
  [[nodiscard]] bool rests(const In& in) const {
    return std::ranges::all_of(in.force_n, [](double x) { return x == 0.0; }) &&
           std::ranges::all_of(in.moment_nm, [](double x) { return x == 0.0; });
  }
  [[nodiscard]] std::string asked() const { return in_text("render %g N along z", force_n_); }
  [[nodiscard]] std::string reported(const In& in) const {
    return in_text("force_n is %g", in.force_n[0]) + in_text(" %g", in.force_n[1]) +
           in_text(" %g", in.force_n[2]);
  }
  [[nodiscard]] std::string advice() const {
    return "apply the wrench with the motors, and report the generated wrench in force_n and moment_nm";
  }

 private:
  double force_n_;
  std::optional<DeviceConfig> device_;
  std::vector<SeenHandle> seen_{};
};

/// A robot. The check commands it to stay in place or, if it may move, to move its first joint by a small
/// amount.
class RobotSubject {
 public:
  using Out = adapter::SetpointDatagram;
  using In = adapter::RobotDatagram;
  static constexpr const char* kWhat = "robot";
  static constexpr const char* kSends = "RobotDatagram";
  static constexpr const char* kAsk = "setpoint";
  static constexpr const char* kRests = "stops and reports kStopped";
  static constexpr double kSettle_s = 1.0;

  explicit RobotSubject(double move_rad) : move_rad_(move_rad) {}

  void know(const In& in) { std::copy_n(in.joint_rad, adapter::kJoints, start_rad_); }
  void watch(std::int64_t /*at_ns*/, const In& in) {
    force_varies_ = force_varies_ || (seen_ && !std::ranges::equal(in.force_n, last_.force_n));
    moment_varies_ = moment_varies_ || (seen_ && !std::ranges::equal(in.moment_nm, last_.moment_nm));
    seen_ = true;
    last_ = in;
  }
  [[nodiscard]] std::vector<Finding> findings() const {
    if (force_varies_ && moment_varies_) return {{FindingVerdict::kOk, "sensor", "its six channels vary"}};
    const std::string advice =
        force_varies_
            ? "for a sensor of three axes, start the slave with sensing.moment=false; for one without "
              "noise, set sensing.moment_noise_nm=0"
            : "for a robot without a force sensor, start the slave with sensing.force=false; for a "
              "sensor without noise, set sensing.force_noise_n=0 and sensing.moment_noise_nm=0";
    return {{FindingVerdict::kWarning, "sensor",
             force_varies_
                 ? "the moment has a single value; with the default settings, the slave does not engage"
                 : "the force has a single value; with the default settings, the slave does not engage",
             advice}};
  }
  /// The setpoint at time t_s of the check. The motion takes place in the first half second.
  [[nodiscard]] Out ask(double t_s) {
    share_ = std::max(share_, std::min(1.0, 2.0 * t_s));
    Out out;
    out.flags = Out::kMove;
    std::copy_n(start_rad_, adapter::kJoints, out.joint_rad);
    out.joint_rad[0] += share_ * move_rad_;
    return out;
  }
  [[nodiscard]] Out poison(Out out) const {
    out.joint_rad[0] += 2.0 * move_rad_;
    return out;
  }
  [[nodiscard]] Out nothing() const { return {}; }
  [[nodiscard]] bool does(const In& in) const {
    const double off = in.joint_rad[0] - (start_rad_[0] + share_ * move_rad_);
    return (in.flags & In::kStopped) == 0 && (move_rad_ == 0.0 || std::abs(off) <= 0.5 * std::abs(move_rad_));
  }
  [[nodiscard]] bool rests(const In& in) const { return (in.flags & In::kStopped) != 0; }
  [[nodiscard]] std::string asked() const {
    return move_rad_ == 0.0 ? "stay in place" : in_text("move the first joint by %g rad (or m)", move_rad_);
  }
  [[nodiscard]] std::string reported(const In& in) const {
    return in_text("the first joint is at %g", in.joint_rad[0]) +
           in_text(" (%g at the start)", start_rad_[0]) +
           (rests(in) ? ", and the adapter reports kStopped" : "");
  }
  [[nodiscard]] std::string advice() const {
    return "follow joint_rad while kMove is set, and clear kStopped";
  }

 private:
  double move_rad_;
  double share_ = 0.0;
  bool seen_ = false, force_varies_ = false, moment_varies_ = false;
  In last_{};
  double start_rad_[adapter::kJoints] = {};
};

}  // namespace longreach
