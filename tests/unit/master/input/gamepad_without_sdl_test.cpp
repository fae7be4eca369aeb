// A build without SDL's headers says which package is missing.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "master/input/gamepad.hpp"

namespace longreach::gamepad_without_sdl_test {
namespace {

TEST(GamepadWithoutSdl, NamesThePackageThatIsMissing) {
  try {
    const Gamepad gamepad("");
    FAIL() << "there is none";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("install libsdl2-dev"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace longreach::gamepad_without_sdl_test
