#pragma once
// From the bytes of a terminal to keys. Pure. Sequences are parsed whole and may be split over reads: CSI
// (ESC [) and SS3 (ESC O) with parameters, the Linux console's ESC [ [, control strings, X10 mouse reports,
// UTF-8, and ESC with another key (Alt). A bracketed paste is one event that does nothing. No part of an
// unknown sequence is a key. Source: ECMA-48 section 5.4; XTerm Control Sequences; rxvt's finals `$`, a to d.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "master/console/keys.hpp"

namespace longreach {

class KeyParser {
 public:
  /// The keys that these bytes complete.
  std::vector<Key> feed(std::string_view bytes);

  /// Nothing has come for 0.1 s: an escape was the key of that name, and what follows is another key.
  void pause();
  /// Nothing has come for 1 s: whatever had begun does not go on.
  void reset() { *this = {}; }

 private:
  enum class State : std::uint8_t {
    kGround,
    kEscape,        // ESC
    kPaused,        // ESC, and then nothing for 0.1 s
    kIntermediate,  // ESC and one of space to '/'
    kControl,       // CSI
    kSingle,        // SS3
    kFunction,      // ESC [ [
    kString,        // until BEL or ESC
    kMouse          // CSI M: three bytes
  };

  std::optional<Key> take(char c);
  std::optional<Key> ground(char c);
  void introduce(char c);
  std::optional<Key> control(char c);

  State state_ = State::kGround;
  bool alt_ = false;    // the sequence has come after another escape
  bool paste_ = false;  // within a bracketed paste
  int left_ = 0;        // bytes of a character or a mouse report that are to come
  std::string body_;    // parameters, or the end of a paste; bounded
};

}  // namespace longreach
