#include "common/link/gripper_words.hpp"

#include <array>
#include <cstdio>

namespace longreach {

std::string in_words(const GripperState& gripper) {
  if (!gripper.closed) return gripper.holds ? "open, and something is in it" : "open";
  if (!gripper.holds) return "closed";
  if (!(gripper.load_sd_kg > 0.0)) return "closed, holds something";
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "closed, holds %.3g kg (standard deviation %.2g)", gripper.load_kg,
                gripper.load_sd_kg);
  return text.data();
}

}  // namespace longreach
