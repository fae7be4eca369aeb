// Gamepads and joysticks by SDL's virtual ones.

#include "master/input/gamepad.hpp"

#include <SDL2/SDL.h>
#include <gtest/gtest.h>

#include "master/input/pad_operator.hpp"

namespace longreach::gamepad_test {
namespace {

/// A thing that SDL takes for one that is plugged in, until it is unplugged.
class VirtualPad {
 public:
  VirtualPad(SDL_JoystickType type, const char* name, int axes = 6, int buttons = 15, int hats = 1) {
    SDL_VirtualJoystickDesc desc{};
    desc.version = SDL_VIRTUAL_JOYSTICK_DESC_VERSION;
    desc.type = static_cast<Uint16>(type);
    desc.naxes = static_cast<Uint16>(axes);
    desc.nbuttons = static_cast<Uint16>(buttons);
    desc.nhats = static_cast<Uint16>(hats);
    desc.name = name;
    desc.userdata = this;
    desc.Rumble = [](void* self, Uint16 low, Uint16) {
      static_cast<VirtualPad*>(self)->rumbled = low;
      return 0;
    };
    index_ = SDL_JoystickAttachVirtualEx(&desc);
    EXPECT_GE(index_, 0) << SDL_GetError();
    joystick_ = SDL_JoystickOpen(index_);
    // Triggers rest at their end.
    if (type == SDL_JOYSTICK_TYPE_GAMECONTROLLER)
      for (const int trigger : {4, 5}) axis(trigger, -1.0);
  }
  ~VirtualPad() { unplug(); }
  VirtualPad(const VirtualPad&) = delete;
  VirtualPad& operator=(const VirtualPad&) = delete;

  void axis(int i, double value) {
    SDL_JoystickSetVirtualAxis(joystick_, i, static_cast<Sint16>(32767.0 * value));
  }
  void button(int i, bool down) { SDL_JoystickSetVirtualButton(joystick_, i, down ? 1 : 0); }
  void hat(Uint8 value) { SDL_JoystickSetVirtualHat(joystick_, 0, value); }
  void unplug() {
    if (joystick_ == nullptr) return;
    SDL_JoystickDetachVirtual(index_);
    SDL_JoystickClose(joystick_);
    joystick_ = nullptr;
  }

  int rumbled = -1;

 private:
  int index_ = -1;
  SDL_Joystick* joystick_ = nullptr;
};

bool pressed(const AxisSample& s, PadButton b) { return (s.buttons >> static_cast<unsigned>(b) & 1U) != 0; }

TEST(Gamepad, TellsItsSticksAndButtons) {
  Gamepad gamepad("");
  EXPECT_FALSE(gamepad.poll().present);
  VirtualPad pad(SDL_JOYSTICK_TYPE_GAMECONTROLLER, "test pad");
  const AxisSample rest = gamepad.poll();
  EXPECT_TRUE(rest.present);
  EXPECT_EQ(gamepad.name(), "test pad");
  EXPECT_LT(rest.push.norm() + rest.twist.norm(), 1e-3);
  EXPECT_EQ(rest.buttons, 0u);
  pad.axis(1, -1.0);  // left stick up: forwards
  pad.axis(0, -0.5);  // and left
  pad.axis(3, -0.25);
  pad.axis(2, 1.0);  // right stick to the right: turns clockwise
  pad.button(SDL_CONTROLLER_BUTTON_A, true);
  pad.button(SDL_CONTROLLER_BUTTON_LEFTSHOULDER, true);
  const AxisSample moved = gamepad.poll();
  EXPECT_LT((moved.push - Vector3(1, 0.5, 0.25)).norm(), 1e-3) << moved.push.transpose();
  EXPECT_LT((moved.twist - Vector3(0, 0, -1)).norm(), 1e-3) << moved.twist.transpose();
  EXPECT_TRUE(pressed(moved, PadButton::kEngage) && pressed(moved, PadButton::kClutch));
  EXPECT_FALSE(pressed(moved, PadButton::kStop));
  pad.axis(5, 1.0);
  EXPECT_NEAR(gamepad.poll().twist.y(), 1.0, 1e-3);
}

TEST(Gamepad, IsLostWhenItIsUnpluggedAndFoundWhenItIsPluggedInAgain) {
  Gamepad gamepad("");
  {
    VirtualPad pad(SDL_JOYSTICK_TYPE_GAMECONTROLLER, "first");
    ASSERT_TRUE(gamepad.poll().present);
  }
  EXPECT_FALSE(gamepad.poll().present);
  EXPECT_EQ(gamepad.name(), "");
  EXPECT_FALSE(gamepad.rumble(1.0));
  VirtualPad again(SDL_JOYSTICK_TYPE_GAMECONTROLLER, "second");
  EXPECT_TRUE(gamepad.poll().present);
  EXPECT_EQ(gamepad.name(), "second");
}

TEST(Gamepad, TakesTheOneWhoseNameIsAskedFor) {
  VirtualPad other(SDL_JOYSTICK_TYPE_GAMECONTROLLER, "another pad");
  Gamepad gamepad("stick");
  EXPECT_FALSE(gamepad.poll().present);
  VirtualPad stick(SDL_JOYSTICK_TYPE_FLIGHT_STICK, "flight stick", 4, 8, 1);
  EXPECT_TRUE(gamepad.poll().present);
  EXPECT_EQ(gamepad.name(), "flight stick");
  stick.axis(1, -1.0);
  stick.axis(2, 0.5);
  stick.axis(3, -0.5);
  stick.button(1, true);
  stick.hat(SDL_HAT_UP | SDL_HAT_RIGHT);
  const AxisSample s = gamepad.poll();
  EXPECT_LT((s.push - Vector3(1, 0, -0.5)).norm(), 1e-3) << s.push.transpose();
  EXPECT_NEAR(s.twist.z(), 0.5, 1e-3);
  EXPECT_TRUE(pressed(s, PadButton::kStop) && pressed(s, PadButton::kScaleUp));
  EXPECT_TRUE(pressed(s, PadButton::kKvUp) && !pressed(s, PadButton::kKvDown));
}

TEST(Gamepad, RumblesByTheForceThatIsFelt) {
  MasterConfig config;
  config.operator_.kind = OperatorKind::kGamepad;
  PadOperator person(config);
  person.poll(MotionMode::kRate, 0.0, 0.02);
  EXPECT_NE(person.trouble().find("plug it in"), std::string::npos);
  VirtualPad pad(SDL_JOYSTICK_TYPE_GAMECONTROLLER, "pad");
  person.poll(MotionMode::kRate, 0.5, 0.02);
  EXPECT_EQ(person.trouble(), "");
  EXPECT_NEAR(pad.rumbled, 32767, 2);
  person.poll(MotionMode::kRate, 7.0, 0.02);
  EXPECT_EQ(pad.rumbled, 65535);
  person.poll(MotionMode::kRate, NAN, 0.02);
  EXPECT_EQ(pad.rumbled, 0);
  pad.axis(1, -1.0);
  EXPECT_GT(person.poll(MotionMode::kRate, 0.0, 0.02).level.target_m.x(), 0.03);
  // A receiver stays when its pad is gone: the sticks read the same for ever.
  for (int i = 0; i < 60; ++i) person.poll(MotionMode::kRate, 0.0, 0.02);
  EXPECT_EQ(person.poll(MotionMode::kRate, 0.0, 0.02).level.target_m, Vector3::Zero());
  EXPECT_NE(person.trouble().find("sends no new reports"), std::string::npos);
  pad.axis(1, -0.99);
  EXPECT_GT(person.poll(MotionMode::kRate, 0.0, 0.02).level.target_m.x(), 0.03);
  EXPECT_EQ(person.trouble(), "");
  pad.unplug();
  EXPECT_FALSE(person.poll(MotionMode::kRate, 0.0, 0.02).level.present);
}

}  // namespace
}  // namespace longreach::gamepad_test
