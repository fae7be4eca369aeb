// Replaces gamepad.cpp in a build without the SDL headers.
#include <stdexcept>

#include "master/input/gamepad.hpp"

namespace longreach {

struct Gamepad::State {
  std::string name;
};

Gamepad::Gamepad(const std::string&) {
  throw std::runtime_error(
      "this build has no gamepad driver, because the SDL headers were missing; install libsdl2-dev, "
      "then configure and build again");
}
Gamepad::~Gamepad() = default;
AxisSample Gamepad::poll() { return {}; }
bool Gamepad::rumble(double) { return false; }
const std::string& Gamepad::name() const { return state_->name; }
std::string_view Gamepad::key_line() { return {}; }

}  // namespace longreach
