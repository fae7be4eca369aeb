#pragma once
// The keyboard of a terminal without waiting: raw mode while it lives, given back on destruction, at exit and
// by every signal that ends the program. Also reads a pipe, without raw mode. Poll it outside the loop.
//
// A keyboard that has ended (end of file, closed terminal, read error) or whose terminal belongs to another
// program (the master is in the background) is a hand that has let go: the target is home, nothing is
// requested any more, and trouble() says why. One in the background is read again when it is brought back.
// In rate mode a hand of which no key came for 2 s goes home.

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

  /// Reads what has been typed, never waits. The requests are those since the last poll. To be called at 50
  /// Hz.
  KeyboardState poll(MotionMode mode);

  /// Why there is no keyboard now, and what to do; empty: it is read.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }
  /// What the person at the keyboard should know now, and what to do; empty: nothing.
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
  bool let_go_ = false;  // for want of keys
  KeyboardState state_{};
};

}  // namespace longreach
