#pragma once
// A simulated haptic device behind an adapter socket, whose handle is moved by the test along x, and whose
// reported pose can be made wrong. It runs in a thread of the test.

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

#include "tests/process/adapter_listener.hpp"

namespace longreach {

class DeviceBox {
 public:
  explicit DeviceBox(std::uint32_t buttons = 0) : buttons_(buttons), thread_([this] { run(); }) {}
  ~DeviceBox() {
    ended_ = true;
    thread_.join();
  }
  DeviceBox(const DeviceBox&) = delete;
  DeviceBox& operator=(const DeviceBox&) = delete;

  [[nodiscard]] std::string address() const { return listener_.address(); }
  /// Moves the handle to this position along x at 20 mm/s from now on.
  void move_to(double m) { target_m_ = m; }
  [[nodiscard]] double at_m() const { return at_m_; }
  /// Multiplies the reported position from now on.
  void scale(double factor) { scale_ = factor; }
  /// Adds this to the reported position from now on.
  void jump(double m) { jump_m_ = m; }
  /// Adds this to every second of the reported positions, which change once per second.
  void chatter(double m) { chatter_m_ = m; }
  /// Presses or releases buttons (flags of HandleDatagram), whose contacts chatter for 4 ms.
  void press(std::uint32_t buttons) { buttons_ = buttons; }
  /// Sends nothing from now on, or sends again.
  void mute(bool muted) { muted_ = muted; }
  /// Reports the quaternion in the order x y z w.
  void swap_quaternion() { swapped_ = true; }
  /// Largest force that was commanded so far, N.
  [[nodiscard]] double force_max_n() const { return force_max_n_; }

 private:
  void run();

  AdapterListener listener_;
  std::atomic<double> target_m_{0.0}, at_m_{0.0}, scale_{1.0}, jump_m_{0.0}, chatter_m_{0.0},
      force_max_n_{0.0};
  std::atomic<std::uint32_t> buttons_{0};
  std::atomic<bool> swapped_{false}, muted_{false}, ended_{false};
  std::thread thread_;
};

}  // namespace longreach
