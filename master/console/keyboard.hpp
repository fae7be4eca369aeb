#pragma once
// The keyboard of a terminal without waiting: raw mode while it lives, given back on destruction, at exit and
// by every signal that ends the program. Also reads a pipe, without raw mode. Poll it outside the loop.

#include "master/console/keys.hpp"

namespace longreach {

class Keyboard {
 public:
  /// Reads the file descriptor `fd`, 0: standard input. One object at a time.
  explicit Keyboard(const KeyboardConfig& config = {}, int fd = 0);
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  /// Reads what has been typed, never waits. The requests are those since the last poll.
  KeyboardState poll(MotionMode mode);

 private:
  KeyboardConfig config_;
  int fd_;
  bool raw_ = false;
  bool ended_ = false;  // end of input
  KeyParser parser_;
  KeyboardState state_{};
};

}  // namespace longreach
