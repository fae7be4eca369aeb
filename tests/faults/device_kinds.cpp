// A haptic device that fails, sticks, drifts or stalls.

#include "tests/faults/world.hpp"

namespace longreach {
namespace {

void unplug(World&, Active& fault, HandleState& told) {
  if (fault.begins) fault.handle = told;
  told = fault.handle;
  told.ok = false;
}
void stick(World&, Active& fault, HandleState& told) {
  if (fault.begins) fault.handle = told;
  told = fault.handle;
}
void stick_with_speed(World&, Active& fault, HandleState& told) {
  if (fault.begins) fault.handle = told;
  told.p_MH = fault.handle.p_MH;
  told.q_MH = fault.handle.q_MH;
}
Vector3 direction(Active& fault) {
  if (fault.begins)
    fault.direction =
        Vector3(fault.random.normal(), fault.random.normal(), fault.random.normal()).normalized();
  return fault.direction;
}
void drift(World&, Active& fault, HandleState& told) {
  const double m_per_s = log_scale(fault.fault.size, 1e-4, 0.1);
  told.p_MH += fault.age_s * m_per_s * direction(fault);
  told.velocity_m_per_s += m_per_s * direction(fault);
}
void leap(World&, Active& fault, HandleState& told) {
  told.p_MH += log_scale(fault.fault.size, 1e-3, 1.0) * direction(fault);
}
void jitter(World&, Active& fault, HandleState& told) {
  const double m = log_scale(fault.fault.size, 1e-6, 3e-4);
  for (int i = 0; i < 3; ++i) told.p_MH[i] += m * fault.random.normal();
}
void stall(World&, Active& fault, HandleState& told) {
  if (fault.count == 0 && fault.random.chance(0.02))
    fault.count = static_cast<std::uint64_t>(1e3 * log_scale(fault.fault.size, 0.005, 0.1));
  if (fault.count == 0 || fault.begins) fault.handle = told;
  if (fault.count > 0) --fault.count;
  told = fault.handle;
}
void press_buttons(World&, Active& fault, HandleState& told) {
  told.buttons.mode = fault.random.chance(0.002);
  told.buttons.clutch = fault.random.chance(0.3);
  told.buttons.scale_up = fault.random.chance(0.02);
  told.buttons.scale_down = fault.random.chance(0.02);
}

constexpr std::string_view kGroup = "device";
constexpr auto kHandle = only(Spoils::kHandle);
constexpr auto kFails = Spoils::kHandle | Spoils::kOperator;

const FaultKind kKinds[] = {
    {.name = "handle-unplugged", .group = kGroup, .spoils = kFails, .longest_s = 3.0, .handle = unplug},
    {.name = "handle-stuck", .group = kGroup, .spoils = kHandle, .handle = stick},
    {.name = "handle-stuck-in-motion", .group = kGroup, .spoils = kHandle, .handle = stick_with_speed},
    {.name = "handle-drifts", .group = kGroup, .spoils = kHandle, .handle = drift},
    {.name = "handle-leaps", .group = kGroup, .spoils = kHandle, .longest_s = 1.0, .handle = leap},
    {.name = "handle-noisy", .group = kGroup, .spoils = kHandle, .handle = jitter},
    {.name = "device-adapter-stalls", .group = kGroup, .spoils = kHandle, .handle = stall},
    {.name = "buttons", .group = kGroup, .longest_s = 2.0, .handle = press_buttons},
};

}  // namespace

std::span<const FaultKind> device_kinds() { return kKinds; }

}  // namespace longreach
