#include "master/input/gamepad.hpp"

#include <SDL2/SDL.h>
#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace longreach {
namespace {

constexpr const char* kSdlLibrary = "libSDL2-2.0.so.0";
constexpr Uint32 kParts = SDL_INIT_GAMECONTROLLER | SDL_INIT_HAPTIC;
constexpr Uint32 kRumble_ms = 200;

/// The functions of SDL that are used, loaded by name.
struct Sdl {
  decltype(&SDL_SetHint) set_hint;
  decltype(&SDL_InitSubSystem) begin;
  decltype(&SDL_QuitSubSystem) end;
  decltype(&SDL_GetError) error;
  decltype(&SDL_JoystickUpdate) update;
  decltype(&SDL_FlushEvents) flush;
  decltype(&SDL_NumJoysticks) count;
  decltype(&SDL_JoystickNameForIndex) name_of;
  decltype(&SDL_IsGameController) is_pad;
  decltype(&SDL_GameControllerOpen) open_pad;
  decltype(&SDL_GameControllerClose) close_pad;
  decltype(&SDL_GameControllerGetJoystick) joystick_of;
  decltype(&SDL_GameControllerGetAxis) pad_axis;
  decltype(&SDL_GameControllerGetButton) pad_button;
  decltype(&SDL_JoystickOpen) open;
  decltype(&SDL_JoystickClose) close;
  decltype(&SDL_JoystickGetAttached) attached;
  decltype(&SDL_JoystickNumAxes) axes;
  decltype(&SDL_JoystickGetAxis) axis;
  decltype(&SDL_JoystickGetButton) button;
  decltype(&SDL_JoystickNumHats) hats;
  decltype(&SDL_JoystickGetHat) hat;
  decltype(&SDL_JoystickRumble) rumble;

  Sdl() {
    void* const library = dlopen(kSdlLibrary, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr)
      throw std::runtime_error(std::string("a gamepad needs SDL, but ") + kSdlLibrary +
                               " cannot be loaded; install libsdl2-2.0-0");
    const auto take = [library](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
      if (function == nullptr)
        throw std::runtime_error(std::string(kSdlLibrary) + " has no function " + name);
    };
    take(set_hint, "SDL_SetHint");
    take(begin, "SDL_InitSubSystem");
    take(end, "SDL_QuitSubSystem");
    take(error, "SDL_GetError");
    take(update, "SDL_JoystickUpdate");
    take(flush, "SDL_FlushEvents");
    take(count, "SDL_NumJoysticks");
    take(name_of, "SDL_JoystickNameForIndex");
    take(is_pad, "SDL_IsGameController");
    take(open_pad, "SDL_GameControllerOpen");
    take(close_pad, "SDL_GameControllerClose");
    take(joystick_of, "SDL_GameControllerGetJoystick");
    take(pad_axis, "SDL_GameControllerGetAxis");
    take(pad_button, "SDL_GameControllerGetButton");
    take(open, "SDL_JoystickOpen");
    take(close, "SDL_JoystickClose");
    take(attached, "SDL_JoystickGetAttached");
    take(axes, "SDL_JoystickNumAxes");
    take(axis, "SDL_JoystickGetAxis");
    take(button, "SDL_JoystickGetButton");
    take(hats, "SDL_JoystickNumHats");
    take(hat, "SDL_JoystickGetHat");
    take(rumble, "SDL_JoystickRumble");
  }
};

double unit(Sint16 value) { return std::clamp(value / 32767.0, -1.0, 1.0); }

struct PadKey {
  int key;
  PadButton button;
};
constexpr auto kPadKeys = std::to_array<PadKey>({{SDL_CONTROLLER_BUTTON_A, PadButton::kEngage},
                                                 {SDL_CONTROLLER_BUTTON_B, PadButton::kStop},
                                                 {SDL_CONTROLLER_BUTTON_X, PadButton::kGripper},
                                                 {SDL_CONTROLLER_BUTTON_Y, PadButton::kMode},
                                                 {SDL_CONTROLLER_BUTTON_LEFTSHOULDER, PadButton::kClutch},
                                                 {SDL_CONTROLLER_BUTTON_RIGHTSHOULDER, PadButton::kClutch},
                                                 {SDL_CONTROLLER_BUTTON_DPAD_UP, PadButton::kScaleUp},
                                                 {SDL_CONTROLLER_BUTTON_DPAD_DOWN, PadButton::kScaleDown},
                                                 {SDL_CONTROLLER_BUTTON_DPAD_RIGHT, PadButton::kKvUp},
                                                 {SDL_CONTROLLER_BUTTON_DPAD_LEFT, PadButton::kKvDown},
                                                 {SDL_CONTROLLER_BUTTON_BACK, PadButton::kHome}});
// In the order in which joysticks number their buttons: the trigger first.
constexpr auto kStickKeys = std::to_array<PadKey>({{0, PadButton::kClutch},
                                                   {1, PadButton::kStop},
                                                   {2, PadButton::kEngage},
                                                   {3, PadButton::kMode},
                                                   {4, PadButton::kGripper},
                                                   {5, PadButton::kHome}});

}  // namespace

struct Gamepad::State {
  explicit State(std::string part) : wanted(std::move(part)) {}

  void find();
  void leave();
  [[nodiscard]] AxisSample read_pad() const;
  [[nodiscard]] AxisSample read_stick() const;

  Sdl sdl;
  std::string wanted, name;
  SDL_GameController* pad = nullptr;  // same device as `stick`; null if SDL does not have its layout
  SDL_Joystick* stick = nullptr;
  AxisSample last{};
};

void Gamepad::State::find() {
  for (int i = 0; i < sdl.count() && stick == nullptr; ++i) {
    const char* const called = sdl.name_of(i);
    const std::string candidate = called != nullptr ? called : "a joystick";
    if (candidate.find(wanted) == std::string::npos) continue;
    if (sdl.is_pad(i) == SDL_TRUE) pad = sdl.open_pad(i);
    stick = pad != nullptr ? sdl.joystick_of(pad) : sdl.open(i);
    if (stick != nullptr) name = candidate;
  }
}

void Gamepad::State::leave() {
  if (pad != nullptr) {
    sdl.close_pad(pad);
  } else if (stick != nullptr) {
    sdl.close(stick);
  }
  pad = nullptr;
  stick = nullptr;
  name.clear();
}

AxisSample Gamepad::State::read_pad() const {
  const auto axis = [this](SDL_GameControllerAxis a) { return unit(sdl.pad_axis(pad, a)); };
  AxisSample s{.present = true};
  // Up and left are negative on a stick, whereas forwards and left are positive in M.
  s.push = {-axis(SDL_CONTROLLER_AXIS_LEFTY), -axis(SDL_CONTROLLER_AXIS_LEFTX),
            -axis(SDL_CONTROLLER_AXIS_RIGHTY)};
  s.twist = {0.0, axis(SDL_CONTROLLER_AXIS_TRIGGERRIGHT) - axis(SDL_CONTROLLER_AXIS_TRIGGERLEFT),
             -axis(SDL_CONTROLLER_AXIS_RIGHTX)};
  for (const PadKey& k : kPadKeys)
    s.press(k.button, sdl.pad_button(pad, static_cast<SDL_GameControllerButton>(k.key)) != 0);
  return s;
}

AxisSample Gamepad::State::read_stick() const {
  const int axes = sdl.axes(stick);
  const auto axis = [&](int i) { return i < axes ? unit(sdl.axis(stick, i)) : 0.0; };
  AxisSample s{.present = true};
  s.push = {-axis(1), -axis(0), -axis(2)};
  s.twist = {0.0, 0.0, -axis(3)};
  for (const PadKey& k : kStickKeys) s.press(k.button, sdl.button(stick, k.key) != 0);
  if (sdl.hats(stick) > 0) {
    const Uint8 hat = sdl.hat(stick, 0);
    s.press(PadButton::kScaleUp, (hat & SDL_HAT_UP) != 0);
    s.press(PadButton::kScaleDown, (hat & SDL_HAT_DOWN) != 0);
    s.press(PadButton::kKvUp, (hat & SDL_HAT_RIGHT) != 0);
    s.press(PadButton::kKvDown, (hat & SDL_HAT_LEFT) != 0);
  }
  return s;
}

Gamepad::Gamepad(const std::string& name) : state_(std::make_unique<State>(name)) {
  const Sdl& sdl = state_->sdl;
  sdl.set_hint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
  /// There is no window that could have the focus.
  sdl.set_hint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
  if (sdl.begin(kParts) != 0)
    throw std::runtime_error(std::string("SDL cannot read gamepads: ") + sdl.error());
}

Gamepad::~Gamepad() {
  state_->leave();
  state_->sdl.end(kParts);
}

AxisSample Gamepad::poll() {
  State& s = *state_;
  s.sdl.update();
  s.sdl.flush(SDL_FIRSTEVENT, SDL_LASTEVENT);  // states are read directly, so events would only accumulate
  if (s.stick != nullptr && s.sdl.attached(s.stick) == SDL_FALSE) s.leave();
  if (s.stick == nullptr) s.find();
  if (s.stick == nullptr) return {};
  AxisSample now = s.pad != nullptr ? s.read_pad() : s.read_stick();
  now.reports = s.last.reports + (now.push != s.last.push || now.twist != s.last.twist ? 1U : 0U);
  return s.last = now;
}

bool Gamepad::rumble(double strength) {
  if (state_->stick == nullptr) return false;
  const double share = strength > 0.0 ? std::min(strength, 1.0) : 0.0;
  const auto level = static_cast<Uint16>(65535.0 * share);
  return state_->sdl.rumble(state_->stick, level, static_cast<Uint16>(level / 2), kRumble_ms) == 0;
}

const std::string& Gamepad::name() const { return state_->name; }

std::string_view Gamepad::key_line() {
  return "left stick: x y   right stick: z, turn   triggers: tilt   A: engage   B: stop   Y: mode   X: "
         "gripper "
         "  shoulder: clutch   up down: scale   right left: kv   back: home";
}

}  // namespace longreach
