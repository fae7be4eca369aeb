#pragma once
// Converts bytes of a terminal to keys. Pure. Sequences are parsed completely and may be split over reads:
// CSI (ESC [) and SS3 (ESC O) with parameters, the Linux console's ESC [ [, control strings, X10 mouse
// reports, UTF-8, ESC with another key (Alt), and 8-bit controls. No part of an unknown sequence is a key.
// Source: ECMA-48 section 5.4; XTerm Control Sequences; rxvt's finals `$`, a to d.
//
// Text that a terminal sends, a bracketed paste or a control string, has no effect until its end, however
// long it pauses. If it has not ended within 1 s, it is overdue: the stop key then acts within it, but no
// other key. Esc also ends it, and so does 1 s without input after a stop.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "master/input/keys.hpp"

namespace longreach {

class KeyParser {
 public:
  /// Returns the keys that these bytes complete.
  std::vector<Key> feed(std::string_view bytes);

  /// Marks the start of a poll of 20 ms; call it before feeding the bytes that the poll reads. Polls are
  /// counted instead of time, because a delayed thread has not polled yet.
  void tick();

  /// Inside text whose end is overdue.
  [[nodiscard]] bool overdue() const { return in_text() && text_polls_ > kTextPolls; }

 private:
  enum class State : std::uint8_t {
    kGround,
    kEscape,        // ESC
    kPaused,        // ESC, followed by no byte for 0.1 s
    kIntermediate,  // ESC and one of space to '/'
    kControl,       // CSI
    kSingle,        // SS3
    kFunction,      // ESC [ [
    kString,        // control string: until BEL or ESC
    kPaste,         // bracketed paste: until ESC [ 201 ~
    kMouse          // CSI M: three bytes
  };
  static constexpr int kTextPolls = 50;  // 1 s

  [[nodiscard]] bool in_text() const { return state_ == State::kString || state_ == State::kPaste; }
  void begin_text(State state);
  void pause();  // no byte for 0.1 s: the escape was the Esc key
  void quiet();  // no byte for 1 s: an incomplete sequence is dropped, except text

  std::optional<Key> next(char c);

  std::optional<Key> take(char c);
  std::optional<Key> stop_in_text(char c);
  std::optional<Key> ground(char c);
  void introduce(char c);
  std::optional<Key> control(char c);

  State state_ = State::kGround;
  bool alt_ = false;        // the sequence followed another escape
  bool stopped_ = false;    // the last byte of the text was a stop that acted
  char lead_ = '\0';        // first byte of the present character
  int character_left_ = 0;  // missing bytes of a UTF-8 character
  int mouse_left_ = 0;      // missing bytes of a mouse report
  int idle_polls_ = 0;      // since the last feed()
  int text_polls_ = 0;      // since the text began
  std::string body_;        // parameters, or what may be the end of a paste; bounded
};

}  // namespace longreach
