#pragma once
// Converts bytes from a terminal to keys. Pure. Sequences are parsed completely and may be split over several
// reads: CSI (ESC [) and SS3 (ESC O) with parameters, the Linux console's ESC [ [, control strings, X10 mouse
// reports, UTF-8, ESC with another key (Alt), and 8-bit controls. No part of an unknown sequence counts as a
// key. Sources: ECMA-48 section 5.4; XTerm Control Sequences; the finals `$` and a to d of rxvt.
//
// Text that the terminal sends as a bracketed paste or a control string has no effect until it ends, even if
// the input pauses. If the text has not ended within 1 s, it is overdue: from then on the stop key, and no
// other key, takes effect inside the text. Esc also ends the text, as does 1 s without input after a stop.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "master/input/keys.hpp"

namespace longreach {

class KeyParser {
 public:
  /// Parses `bytes`. Returns the keys that these bytes complete.
  std::vector<Key> feed(std::string_view bytes);

  /// Marks the start of a poll. Polls occur every 20 ms. Call this before feeding the bytes that the poll
  /// reads. Timeouts count polls instead of measuring time, so that a delayed thread does not time out input
  /// that it has not read yet.
  void tick();

  /// Returns whether the input is inside text that has not ended in time.
  [[nodiscard]] bool overdue() const { return in_text() && text_polls_ > kTextPolls; }

 private:
  enum class State : std::uint8_t {
    kGround,
    kEscape,        // ESC
    kPaused,        // ESC, then no byte for 0.1 s
    kIntermediate,  // ESC and a byte from space to '/'
    kControl,       // CSI
    kSingle,        // SS3
    kFunction,      // ESC [ [
    kString,        // control string, until BEL or ESC
    kPaste,         // bracketed paste, until ESC [ 201 ~
    kMouse          // CSI M, followed by three bytes
  };
  static constexpr int kTextPolls = 50;  // 1 s

  [[nodiscard]] bool in_text() const { return state_ == State::kString || state_ == State::kPaste; }
  void begin_text(State state);
  void pause();  // no byte for 0.1 s: the ESC was the Esc key
  void quiet();  // no byte for 1 s: drops an incomplete sequence, except text

  std::optional<Key> next(char c);

  std::optional<Key> take(char c);
  std::optional<Key> stop_in_text(char c);
  std::optional<Key> ground(char c);
  void introduce(char c);
  std::optional<Key> control(char c);

  State state_ = State::kGround;
  bool alt_ = false;        // the sequence followed another ESC
  bool stopped_ = false;    // the last byte of the text acted as a stop
  char lead_ = '\0';        // first byte of the current character
  int character_left_ = 0;  // remaining bytes of a UTF-8 character
  int mouse_left_ = 0;      // remaining bytes of a mouse report
  int idle_polls_ = 0;      // polls since the last feed()
  int text_polls_ = 0;      // polls since the text began
  std::string body_;        // parameters, or a possible end of a paste; bounded
};

}  // namespace longreach
