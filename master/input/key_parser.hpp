#pragma once
// From the bytes of a terminal to keys. Pure. Sequences are parsed whole and may be split over reads: CSI
// (ESC [) and SS3 (ESC O) with parameters, the Linux console's ESC [ [, control strings, X10 mouse reports,
// UTF-8, ESC with another key (Alt), and the controls of eight bits. No part of an unknown sequence is a key.
// Source: ECMA-48 section 5.4; XTerm Control Sequences; rxvt's finals `$`, a to d.
//
// Text that a terminal sends, a bracketed paste or a control string, does nothing until its end, however long
// it pauses. Where its end has not come within 1 s of its beginning, it is overdue: the key of stop acts
// within it, and no other. Then the key Esc ends it, too, and so does 1 s without input after a stop.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "master/input/keys.hpp"

namespace longreach {

class KeyParser {
 public:
  /// The keys that these bytes complete.
  std::vector<Key> feed(std::string_view bytes);

  /// A poll of 20 ms has begun; to be called before what it reads is fed. Polls are counted, not time, since
  /// a thread that was late has not looked yet.
  void tick();

  /// Within text whose end should have come.
  [[nodiscard]] bool overdue() const { return in_text() && text_polls_ > kTextPolls; }

 private:
  enum class State : std::uint8_t {
    kGround,
    kEscape,        // ESC
    kPaused,        // ESC, and then nothing for 0.1 s
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
  void pause();  // nothing has come for 0.1 s: an escape was the key of that name
  void quiet();  // nothing has come for 1 s: what had begun does not go on, but for text

  std::optional<Key> next(char c);

  std::optional<Key> take(char c);
  std::optional<Key> stop_in_text(char c);
  std::optional<Key> ground(char c);
  void introduce(char c);
  std::optional<Key> control(char c);

  State state_ = State::kGround;
  bool alt_ = false;        // the sequence has come after another escape
  bool stopped_ = false;    // the last byte of the text was a stop that acted
  char lead_ = '\0';        // byte that began the present character
  int character_left_ = 0;  // bytes of a character in UTF-8 that are to come
  int mouse_left_ = 0;      // bytes of a mouse report that are to come
  int idle_polls_ = 0;      // since something was fed
  int text_polls_ = 0;      // since the text began
  std::string body_;        // parameters, or what may be the end of a paste; bounded
};

}  // namespace longreach
