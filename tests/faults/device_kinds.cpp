// A haptic device that fails, sticks, drifts or stalls.

#include "tests/faults/world.hpp"

namespace longreach {
namespace {

void unplug(World&, Active& fault, HandleState& reported) {
  if (fault.begins) fault.handle = reported;
  reported = fault.handle;
  reported.ok = false;
}
void stick(World&, Active& fault, HandleState& reported) {
  if (fault.begins) fault.handle = reported;
  reported = fault.handle;
}
void stick_with_speed(World&, Active& fault, HandleState& reported) {
  if (fault.begins) fault.handle = reported;
  reported.p_MH = fault.handle.p_MH;
  reported.q_MH = fault.handle.q_MH;
}
Vector3 direction(Active& fault) {
  if (fault.begins)
    fault.direction =
        Vector3(fault.random.normal(), fault.random.normal(), fault.random.normal()).normalized();
  return fault.direction;
}
void drift(World&, Active& fault, HandleState& reported) {
  const double m_per_s = log_scale(fault.fault.size, 1e-4, 0.1);
  reported.p_MH += fault.age_s * m_per_s * direction(fault);
  reported.velocity_m_per_s += m_per_s * direction(fault);
}
void leap(World&, Active& fault, HandleState& reported) {
  reported.p_MH += log_scale(fault.fault.size, 1e-3, 1.0) * direction(fault);
}
/// Another unit of length: millimetres as metres, or the reverse.
void scale(World&, Active& fault, HandleState& reported) {
  const double factor = fault.fault.size < 0.7 ? 1e3 : 1e-3;
  reported.p_MH *= factor;
  reported.velocity_m_per_s *= factor;
}
/// A quaternion in another order.
void swap_quaternion(World&, Active&, HandleState& reported) {
  const Quaternion q = reported.q_MH;
  reported.q_MH = Quaternion(q.x(), q.y(), q.z(), q.w());
}
void jitter(World&, Active& fault, HandleState& reported) {
  const double m = log_scale(fault.fault.size, 1e-6, 3e-4);
  for (int i = 0; i < 3; ++i) reported.p_MH[i] += m * fault.random.normal();
}
void stall(World&, Active& fault, HandleState& reported) {
  if (fault.count == 0 && fault.random.chance(0.02))
    fault.count = static_cast<std::uint64_t>(1e3 * log_scale(fault.fault.size, 0.005, 0.1));
  if (fault.count == 0 || fault.begins) fault.handle = reported;
  if (fault.count > 0) --fault.count;
  reported = fault.handle;
}
void press_buttons(World&, Active& fault, HandleState& reported) {
  reported.buttons.mode = fault.random.chance(0.002);
  reported.buttons.clutch = fault.random.chance(0.3);
  reported.buttons.scale_up = fault.random.chance(0.02);
  reported.buttons.scale_down = fault.random.chance(0.02);
}

constexpr std::string_view kGroup = "device";
constexpr auto kHandle = only(AffectedSignal::kHandle);
constexpr auto kFails = AffectedSignal::kHandle | AffectedSignal::kOperator;

const FaultKind kKinds[] = {
    {.name = "handle-unplugged", .group = kGroup, .affects = kFails, .longest_s = 3.0, .handle = unplug},
    {.name = "handle-stuck", .group = kGroup, .affects = kHandle, .handle = stick},
    {.name = "handle-stuck-in-motion", .group = kGroup, .affects = kHandle, .handle = stick_with_speed},
    {.name = "handle-drifts", .group = kGroup, .affects = kHandle, .handle = drift},
    {.name = "handle-leaps", .group = kGroup, .affects = kHandle, .longest_s = 1.0, .handle = leap},
    {.name = "handle-scaled",
     .group = kGroup,
     .affects = kHandle,
     .longest_s = 3.0,
     .shortest_s = 0.2,
     .besides = 0.15,
     .handle = scale},
    {.name = "handle-quaternion-swapped",
     .group = kGroup,
     .affects = kHandle,
     .longest_s = 2.0,
     .handle = swap_quaternion},
    {.name = "handle-noisy", .group = kGroup, .affects = kHandle, .handle = jitter},
    {.name = "device-adapter-stalls", .group = kGroup, .affects = kHandle, .handle = stall},
    {.name = "buttons", .group = kGroup, .longest_s = 2.0, .handle = press_buttons},
};

}  // namespace

std::span<const FaultKind> device_kinds() { return kKinds; }

}  // namespace longreach
