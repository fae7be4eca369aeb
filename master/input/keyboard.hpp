#pragma once
// Reads keys from a terminal without blocking. The terminal is in raw mode during the lifetime of the object;
// its mode is restored on destruction, at exit and by every signal that ends the program. A pipe can be read
// as well, without raw mode. Poll the keyboard outside the loop.
//
// If the input has ended (end of file, closed terminal, read error) or the terminal belongs to another
// program (the master is in the background), the handle counts as released: the target is home, there are no
// requests, and trouble() gives the reason. Reading resumes when the program returns to the foreground. In
// rate mode the hand returns to its home position after 2 s without a key.

#include <string>
#include <string_view>

#include "master/input/key_allowance.hpp"
#include "master/input/key_parser.hpp"

namespace longreach {

class Keyboard {
 public:
  /// Reads the file descriptor `fd` (0 is standard input). Only one object may exist at a time.
  explicit Keyboard(const KeyboardConfig& config = {}, int fd = 0);
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  /// Reads pending input without waiting. The returned requests are those since the last poll, `since_s` ago. Call this
  /// at 50 Hz. `elsewhere`: another hand has the handle, so that only the stop, quit and help keys count.
  KeyboardState poll(MotionMode mode, double since_s, bool elsewhere = false);
  /// Makes the hand begin at this pose, relative to the handle's home, M.
  void begin_at(const Vector3& target_m, const Vector3& target_rad) {
    state_.target_m = target_m;
    state_.target_rad = target_rad;
  }

  /// Returns why the keyboard is not available, and a remedy; empty if it is available.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }
  /// Returns a notice for the user at the keyboard, with a remedy; empty if there is none.
  [[nodiscard]] std::string notice() const;

 private:
  void set_raw();
  void read_all(MotionMode mode);
  void go_home();
  void end(const std::string& why);

  KeyboardConfig config_;
  int fd_;
  bool raw_ = false;
  bool ended_ = false;
  bool used_ = false;  // some input has been read
  std::string trouble_;
  KeyParser parser_;
  KeyAllowance allowance_;
  int idle_polls_ = 0;   // polls since a key was read
  bool let_go_ = false;  // the target is home because no key was pressed
  KeyboardState state_{};
};

}  // namespace longreach
