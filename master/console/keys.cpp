#include "master/console/keys.hpp"

#include <cctype>
#include <optional>

namespace longreach {
namespace {

constexpr char kEscape = '\x1b';
constexpr std::size_t kPendingMax = 16;  // longer sequences are not keys that we know

Key move(int axis, int sign, bool large) { return {KeyAction::kMove, axis, sign, large}; }

std::optional<Key> letter(char c) {
  const bool large = std::isupper(static_cast<unsigned char>(c)) != 0;
  switch (std::tolower(static_cast<unsigned char>(c))) {
    case 'w':
      return move(0, +1, large);
    case 's':
      return move(0, -1, large);
    case 'a':
      return move(1, +1, large);
    case 'd':
      return move(1, -1, large);
    case 'r':
      return move(2, +1, large);
    case 'f':
      return move(2, -1, large);
    case ' ':
      return Key{KeyAction::kHome};
    case 'm':
      return Key{KeyAction::kMode};
    case '+':
    case '=':
      return Key{KeyAction::kScaleUp};  // '=' is '+' without shift
    case '-':
    case '_':
      return Key{KeyAction::kScaleDown};
    case 'g':
      return Key{KeyAction::kLoad};
    case 'c':
      return Key{KeyAction::kClutch};
    case 'e':
      return Key{KeyAction::kEngage};
    case 'x':
      return Key{KeyAction::kStop};
    case 'q':
      return Key{KeyAction::kQuit};
    case '?':
      return Key{KeyAction::kHelp};
    default:
      return std::nullopt;
  }
}

// What follows ESC [ or ESC O, with its final byte. "1;2A": the 2 is shift.
std::optional<Key> sequence(std::string_view body) {
  const bool large = body.find(";2") != std::string_view::npos;
  switch (body.back()) {
    case 'A':
      return move(0, +1, large);
    case 'B':
      return move(0, -1, large);
    case 'D':
      return move(1, +1, large);
    case 'C':
      return move(1, -1, large);
    case '~':
      if (body.front() == '5') return move(2, +1, large);
      if (body.front() == '6') return move(2, -1, large);
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

bool is_final(char c) { return c >= '@' && c <= '~'; }

}  // namespace

std::vector<Key> KeyParser::feed(std::string_view bytes) {
  std::vector<Key> keys;
  for (const char c : bytes) {
    // An escape always begins anew; a sequence that is too long was none.
    if (c == kEscape || pending_.size() >= kPendingMax) pending_.clear();
    if (c == kEscape) {
      pending_ = c;
      continue;
    }
    const bool introduced = pending_.size() >= 2;
    if (pending_.size() == 1 && (c == '[' || c == 'O')) {
      pending_ += c;
      continue;
    }
    if (introduced && !is_final(c)) {
      pending_ += c;
      continue;
    }
    const std::optional<Key> key = introduced ? sequence(pending_.substr(2) + c) : letter(c);
    pending_.clear();
    if (key) keys.push_back(*key);
  }
  return keys;
}

void apply(const Key& key, const KeyboardConfig& config, MotionMode mode, KeyboardState& state) {
  OperatorRequests& requests = state.requests;
  switch (key.action) {
    case KeyAction::kMove:
      state.target_m[key.axis] += key.sign * (key.large ? config.large_step_m : config.step_m);
      state.target_m = clamp_norm(state.target_m, config.workspace_m);
      return;
    case KeyAction::kHome:
      state.target_m.setZero();
      return;
    case KeyAction::kMode: {
      // Pressed twice between two polls it is back where it was.
      const MotionMode from = requests.mode.value_or(mode);
      requests.mode = from == MotionMode::kRate ? MotionMode::kPosition : MotionMode::kRate;
      return;
    }
    case KeyAction::kScaleUp:
      ++requests.scale_steps;
      return;
    case KeyAction::kScaleDown:
      --requests.scale_steps;
      return;
    case KeyAction::kClutch:
      requests.clutch = !requests.clutch;
      return;
    case KeyAction::kLoad:
      state.loaded = !state.loaded;
      requests.load = state.loaded;
      return;
    // Whatever was typed since the last poll, a stop among it wins.
    case KeyAction::kEngage:
      requests.engage = !requests.stop;
      return;
    case KeyAction::kStop:
      requests.stop = true;
      requests.engage = false;
      return;
    case KeyAction::kQuit:
      state.quit = true;
      return;
    case KeyAction::kHelp:
      state.show_keys = !state.show_keys;
      return;
  }
}

std::string_view key_line() {
  return "w s / up down: x   a d / left right: y   r f / page up down: z   shift: large step   space: let go "
         "  "
         "m: mode   + -: scale   c: clutch   g: gripper loaded   e: engage   x: stop   q: quit   ?: keys";
}

}  // namespace longreach
