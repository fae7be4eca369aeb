#include "master/input/key_parser.hpp"

#include <algorithm>
#include <cctype>

namespace longreach {
namespace {

constexpr char kEscape = '\x1b', kBell = '\a', kCancel = '\x18', kSubstitute = '\x1a';
constexpr int kPausePolls = 5, kQuietPolls = 50;  // 0.1 s and 1 s
constexpr std::size_t kBodyMax = 16;              // no supported key has a longer sequence
constexpr std::string_view kPasteEnd = "\x1b[201~";

Key move(int axis, int sign, bool large) { return {KeyAction::kMove, axis, sign, large}; }

/// For each axis, the key of the positive direction and that of the negative one.
constexpr std::string_view kMoves = "wsadrf", kTurns = "uoikjl";

std::optional<Key> letter(char c) {
  const bool large = std::isupper(static_cast<unsigned char>(c)) != 0;
  const char small = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const KeyAction action : {KeyAction::kMove, KeyAction::kTurn}) {
    const std::size_t at = (action == KeyAction::kMove ? kMoves : kTurns).find(small);
    if (at != std::string_view::npos)
      return Key{action, static_cast<int>(at / 2), at % 2 == 0 ? 1 : -1, large};
  }
  switch (small) {
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
    case '.':
    case '>':
      return Key{KeyAction::kKvUp};  // '>' is '.' with shift
    case ',':
    case '<':
      return Key{KeyAction::kKvDown};
    case 'g':
      return Key{KeyAction::kGripper};
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

/// Returns the key for parameters and final byte. The second parameter is the modifier: absent or 1 means
/// none, 2 means shift.
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

/// Returns the number of bytes that follow the first byte `c` of a UTF-8 character (RFC 3629); 0 if `c` does
/// not begin a multi-byte character.
int continuation(char c) {
  return between(c, 0xf0, 0xf4) ? 3 : between(c, 0xe0, 0xef) ? 2 : between(c, 0xc2, 0xdf) ? 1 : 0;
}

}  // namespace

std::vector<Key> KeyParser::feed(std::string_view bytes) {
  if (!bytes.empty()) idle_polls_ = 0;
  std::vector<Key> keys;
  for (const char c : bytes) {
    if (const auto key = next(c)) keys.push_back(*key);
  }
  return keys;
}

void KeyParser::tick() {
  ++idle_polls_;
  if (in_text()) ++text_polls_;
  if (idle_polls_ == kPausePolls) pause();
  if (idle_polls_ == kQuietPolls) quiet();
}

void KeyParser::pause() {
  if (state_ == State::kEscape) state_ = State::kPaused;
  if (state_ == State::kIntermediate || state_ == State::kMouse) state_ = State::kGround;
  // The Esc key ends a paste whose end was lost. The end sequence of a normal paste may be split after its
  // ESC, so this applies only when the paste is overdue.
  if (state_ == State::kPaste && overdue() && body_.ends_with(kEscape)) state_ = State::kPaused;
}

void KeyParser::quiet() {
  if (!in_text() || (overdue() && stopped_)) *this = {};
}

void KeyParser::begin_text(State state) {
  state_ = state;
  text_polls_ = 0;
  stopped_ = false;
  body_.clear();
}

/// An 8-bit control (C1) is equivalent to ESC and a letter. A UTF-8 continuation byte is not a control, but
/// C2 followed by 80 to 9F is the same control in UTF-8.
std::optional<Key> KeyParser::next(char c) {
  if (state_ == State::kMouse) {  // the bytes of a mouse report are numbers
    if (--mouse_left_ == 0) state_ = State::kGround;
    return std::nullopt;
  }
  const bool continues = character_left_ > 0 && between(c, 0x80, 0xbf);
  if (!continues) lead_ = c;
  character_left_ = continues ? character_left_ - 1 : continuation(c);
  if (!between(c, 0x80, 0x9f) || (continues && lead_ != '\xc2')) return take(c);
  take(kEscape);
  return take(static_cast<char>(static_cast<unsigned char>(c) - 0x40));
}

std::optional<Key> KeyParser::take(char c) {
  if (state_ == State::kPaste) {
    body_ += c;
    if (body_.size() > kPasteEnd.size()) body_.erase(0, 1);
    if (body_ == kPasteEnd) state_ = State::kGround;
    return stop_in_text(c);
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
      // A slow connection may have split a sequence here, so neither byte is a key.
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
      return stop_in_text(c);
    case State::kIntermediate:
      if (!between(c, ' ', '/')) state_ = State::kGround;
      return std::nullopt;
    case State::kFunction:
      state_ = State::kGround;
      return std::nullopt;
    case State::kMouse:
    case State::kPaste:
      return std::nullopt;  // handled above
  }
  return std::nullopt;
}

std::optional<Key> KeyParser::stop_in_text(char c) {
  stopped_ = overdue() && (c == 'x' || c == 'X');
  return stopped_ ? letter(c) : std::nullopt;
}

std::optional<Key> KeyParser::ground(char c) {
  alt_ = false;
  return between(c, 0x80, 0xff) ? std::nullopt : letter(c);
}

/// Handles the byte after ESC. Any other byte is a key with Alt, which has no function.
void KeyParser::introduce(char c) {
  body_.clear();
  state_ = State::kGround;
  if (c == '[') state_ = State::kControl;
  if (c == 'O') state_ = State::kSingle;
  if (std::string_view("PX]^_").find(c) != std::string_view::npos) begin_text(State::kString);
  if (between(c, ' ', '/')) state_ = State::kIntermediate;
}

std::optional<Key> KeyParser::control(char c) {
  if (state_ == State::kControl && body_.empty() && c == '[') {
    state_ = State::kFunction;
    return std::nullopt;
  }
  // By the grammar, '$' is followed by a letter. rxvt ends sequences with '$'; then there is exactly one
  // number.
  const bool number =
      !body_.empty() && std::ranges::all_of(body_, [](char d) { return between(d, '0', '9'); });
  if (between(c, ' ', '?') && !(c == '$' && number)) {
    if (body_.size() < kBodyMax) body_ += c;
    return std::nullopt;
  }
  if (between(c, 0, 0x1f)) return std::nullopt;  // a control character within a sequence is not part of it
  const bool whole = state_ == State::kControl;
  state_ = State::kGround;
  if (between(c, 0x7f, 0xff)) return ground(c);  // neither is this byte, but it ends the sequence
  if (whole && c == '~' && body_ == "200") {
    begin_text(State::kPaste);
  } else if (whole && c == 'M' && body_.empty()) {
    state_ = State::kMouse;
    mouse_left_ = 3;
  } else if (!alt_ && (whole || !between(c, 'a', 'd'))) {
    return sequence(body_, c);
  }
  return std::nullopt;
}

}  // namespace longreach
