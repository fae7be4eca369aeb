#include "tests/process/robot_box.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace longreach {
namespace {

using adapter::RobotDatagram;
using adapter::SetpointDatagram;

std::int64_t now_ns() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

}  // namespace

void RobotBox::take(const SetpointDatagram& in) {
  ++reported_;
  const std::lock_guard lock(mutex_);
  const bool moves = (in.flags & SetpointDatagram::kMove) != 0;
  ReportedSetpoint reported{in.header.sequence, moves, {in.joint_rad[0], in.joint_rad[1], in.joint_rad[2]}};
  for (std::size_t i = 0; i < reported.joint.size(); ++i)
    reported.off = std::max(reported.off, std::abs(reported.joint[i] - joint_[i]));
  setpoints_.push_back(reported);
  if (moves) {
    ++live_;
    for (std::size_t i = 0; i < joint_.size(); ++i) {
      double& worst = follows_ ? step_ : first_step_;
      worst = std::max(worst, std::abs(in.joint_rad[i] - (follows_ ? setpoint_[i] : joint_[i])));
      setpoint_[i] = in.joint_rad[i];
    }
  }
  follows_ = moves;
}

// The axes of the tool are -z, y and x of the base.
void RobotBox::apply(const std::array<double, 3>& felt, double weight, double (&reported)[3]) const {
  const std::array<double, 3> in_tool{-felt[2], felt[1], felt[0]};
  std::ranges::copy(flaw_ == SensorFlaw::kBase ? felt : in_tool, reported);
  if (flaw_ == SensorFlaw::kSign)
    for (double& x : reported) x = -x;
  if (flaw_ == SensorFlaw::kExchanged) std::swap(reported[0], reported[1]);
  if (flaw_ == SensorFlaw::kWeight) reported[0] += weight;
  if (flaw_ == SensorFlaw::kDead) reported[1] = 0.0;
}

RobotDatagram RobotBox::move(double dt) {
  const std::lock_guard lock(mutex_);
  RobotDatagram out;
  out.flags = (fails_ ? 0U : RobotDatagram::kOk) | (follows_ ? 0U : RobotDatagram::kStopped);
  for (std::size_t i = 0; i < 3; ++i) {
    const double servo = follows_ ? 2.0 * std::numbers::pi * 10.0 * (setpoint_[i] - joint_[i]) : 0.0;
    const double speed = std::clamp(servo, -0.5, 0.5) + (i == 2 ? pushed_m_per_s_.load() : 0.0);
    joint_[i] += dt * speed;
    out.joint_rad[i] = joint_[i];
    out.joint_rad_per_s[i] = speed;
  }
  out.joint_rad[2] += fault_m_;
  sense(out);
  return out;
}

void RobotBox::sense(RobotDatagram& out) {
  std::array<double, 3> felt_n = force_n_, felt_nm = moment_nm_;
  felt_n[0] -= 1000.0 * std::max(0.0, joint_[2] - wall_m_);
  for (double& x : felt_n) x += 0.05 * random_.normal();
  for (double& x : felt_nm) x += 0.005 * random_.normal();
  apply(felt_n, 15.0, out.force_n);
  apply(felt_nm, 0.0, out.moment_nm);
  if (flaw_ == SensorFlaw::kZero) std::ranges::fill(out.force_n, 0.0);
  if (flaw_ == SensorFlaw::kZero || flaw_ == SensorFlaw::kNoMoment) std::ranges::fill(out.moment_nm, 0.0);
  if (flaw_ == SensorFlaw::kFrozen) {
    std::ranges::copy(sensed_.force_n, out.force_n);
    std::ranges::copy(sensed_.moment_nm, out.moment_nm);
  }
  sensed_ = out;
}

void RobotBox::run() {
  adapter::Exchange exchange(7);
  std::array<std::byte, 2048> bytes{};
  std::int64_t before_ns = now_ns();
  while (!ended_) {
    while (const auto size = listener_.receive(bytes)) {
      SetpointDatagram in;
      if (adapter::decode(bytes.data(), *size, in) && exchange.accept(in.header, now_ns())) take(in);
    }
    if (exchange.silent(now_ns())) {
      const std::lock_guard lock(mutex_);
      follows_ = false;
    }
    const std::int64_t at_ns = now_ns();
    RobotDatagram out = move(1e-9 * static_cast<double>(at_ns - before_ns));
    before_ns = at_ns;
    exchange.stamp(out);
    listener_.send(std::as_bytes(std::span(&out, 1)));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace longreach
