#include "master/console/key_parser.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace longreach {
namespace {

constexpr char kEscape = '\x1b', kBell = '\a', kCancel = '\x18', kSubstitute = '\x1a';
constexpr std::size_t kBodyMax = 16;  // no key that we know has more
constexpr std::string_view kPasteEnd = "\x1b[201~";

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

std::optional<Key> arrow(char c, bool large) {
  switch (c) {
    case 'A':
      return move(0, +1, large);
    case 'B':
      return move(0, -1, large);
    case 'D':
      return move(1, +1, large);
    case 'C':
      return move(1, -1, large);
    default:
      return std::nullopt;
  }
}

/// Parameters and final byte. The second parameter is the modifier: none or 1, or shift, which is 2.
std::optional<Key> sequence(std::string_view body, char c) {
  if (c == '~' || c == '$') {
    const bool large = c == '$' || body.ends_with(";2");  // '$': shift in rxvt
    const std::string_view page = body.substr(0, body.find(';'));
    if (body != page && body.substr(1) != ";1" && body.substr(1) != ";2") return std::nullopt;
    if (page == "5") return move(2, +1, large);
    if (page == "6") return move(2, -1, large);
    return std::nullopt;
  }
  if (body.empty() && c >= 'a' && c <= 'd') return arrow(static_cast<char>(c - 'a' + 'A'), true);  // rxvt
  if (body.empty() || body == "1" || body == "1;1") return arrow(c, false);
  if (body == "1;2" || body == "2") return arrow(c, true);
  return std::nullopt;
}

bool between(char c, int low, int high) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= low && byte <= high;
}

/// Bytes that follow the first one of a character in UTF-8.
int continuation(char c) { return between(c, 0xf0, 0xff) ? 3 : between(c, 0xe0, 0xef) ? 2 : 1; }

}  // namespace

std::vector<Key> KeyParser::feed(std::string_view bytes) {
  std::vector<Key> keys;
  for (const char c : bytes) {
    if (const auto key = take(c)) keys.push_back(*key);
  }
  return keys;
}

void KeyParser::pause() {
  left_ = 0;
  if (state_ == State::kEscape) state_ = State::kPaused;
  if (state_ == State::kIntermediate || state_ == State::kMouse) state_ = State::kGround;
}

std::optional<Key> KeyParser::take(char c) {
  if (paste_) {
    body_ += c;
    if (body_.size() > kPasteEnd.size()) body_.erase(0, 1);
    paste_ = body_ != kPasteEnd;
    return std::nullopt;
  }
  if (c == kEscape) {
    alt_ = state_ == State::kEscape;
    state_ = State::kEscape;
    return std::nullopt;
  }
  if (c == kCancel || c == kSubstitute) state_ = State::kGround;
  switch (state_) {
    case State::kGround:
      return ground(c);
    case State::kEscape:
      introduce(c);
      return std::nullopt;
    case State::kPaused:
      // A link may have split a sequence here; neither byte is a key.
      if (c != '[' && c != 'O') {
        state_ = State::kGround;
        return ground(c);
      }
      introduce(c);
      return std::nullopt;
    case State::kControl:
    case State::kSingle:
      return control(c);
    case State::kString:
      if (c == kBell) state_ = State::kGround;
      return std::nullopt;
    case State::kIntermediate:
      if (!between(c, ' ', '/')) state_ = State::kGround;
      return std::nullopt;
    case State::kMouse:
      if (--left_ == 0) state_ = State::kGround;
      return std::nullopt;
    case State::kFunction:
      state_ = State::kGround;
  }
  return std::nullopt;
}

std::optional<Key> KeyParser::ground(char c) {
  if (std::exchange(left_, std::max(left_ - 1, 0)) > 0 && between(c, 0x80, 0xbf)) return std::nullopt;
  left_ = between(c, 0xc0, 0xff) ? continuation(c) : 0;
  alt_ = false;
  // The controls of eight bits are ESC and a letter in one.
  if (between(c, 0x80, 0x9f)) introduce(static_cast<char>(static_cast<unsigned char>(c) - 0x40));
  return between(c, 0x80, 0xff) ? std::nullopt : letter(c);
}

/// After ESC; every other byte is a key with Alt, which does nothing.
void KeyParser::introduce(char c) {
  body_.clear();
  state_ = State::kGround;
  if (between(c, 0xc0, 0xff)) left_ = continuation(c);
  if (c == '[') state_ = State::kControl;
  if (c == 'O') state_ = State::kSingle;
  if (std::string_view("PX]^_").find(c) != std::string_view::npos) state_ = State::kString;
  if (between(c, ' ', '/')) state_ = State::kIntermediate;
}

std::optional<Key> KeyParser::control(char c) {
  if (state_ == State::kControl && body_.empty() && c == '[') {
    state_ = State::kFunction;
    return std::nullopt;
  }
  // By the grammar '$' is followed by a letter; rxvt ends with it, and then there is one number.
  const bool number =
      !body_.empty() && std::ranges::all_of(body_, [](char d) { return between(d, '0', '9'); });
  if (between(c, ' ', '?') && !(c == '$' && number)) {
    if (body_.size() < kBodyMax) body_ += c;
    return std::nullopt;
  }
  if (between(c, 0, 0x1f)) return std::nullopt;  // a control within a sequence is not part of it
  const bool whole = state_ == State::kControl;
  state_ = State::kGround;
  if (between(c, 0x7f, 0xff)) return ground(c);  // nor is this; it ends it
  if (whole && c == '~' && body_ == "200") {
    paste_ = true;
    body_.clear();
  } else if (whole && c == 'M' && body_.empty()) {
    state_ = State::kMouse;
    left_ = 3;
  } else if (!alt_ && (whole || !between(c, 'a', 'd'))) {
    return sequence(body_, c);
  }
  return std::nullopt;
}

}  // namespace longreach
