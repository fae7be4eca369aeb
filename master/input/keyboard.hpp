#pragma once
// Keyboard of a terminal, without blocking: raw mode during the lifetime of the object, restored on
// destruction, at exit and by every signal that ends the program. It also reads a pipe, without raw mode.
// Poll it outside the loop.
//
// If the keyboard has ended (end of file, closed terminal, read error) or its terminal belongs to another
// program (the master is in the background), the handle counts as released: the target is home, there are no
// requests, and trouble() gives the reason. A program in the background reads again when it returns to the
// foreground. In rate mode the hand goes home after 2 s without a key.

#include <string>
#include <string_view>

#include "master/input/key_parser.hpp"

namespace longreach {

class Keyboard {
 public:
  /// Reads the file descriptor `fd`, 0: standard input. One object at a time.
  explicit Keyboard(const KeyboardConfig& config = {}, int fd = 0);
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  /// Reads pending input, never waits. The requests are those since the last poll. Call it at 50 Hz.
  KeyboardState poll(MotionMode mode);

  /// Returns why there is no keyboard now, and a remedy; empty: it is available.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }
  /// Returns a notice for the user at the keyboard, and a remedy; empty: none.
  [[nodiscard]] std::string_view notice() const;

 private:
  void set_raw();
  void read_all(MotionMode mode);
  void end(const std::string& why);

  KeyboardConfig config_;
  int fd_;
  bool raw_ = false;
  bool ended_ = false;
  bool used_ = false;  // something has been read
  std::string trouble_;
  KeyParser parser_;
  int idle_polls_ = 0;   // since a key was read
  bool let_go_ = false;  // because no key was pressed
  KeyboardState state_{};
};

}  // namespace longreach
