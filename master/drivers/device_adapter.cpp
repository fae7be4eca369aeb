#include "master/drivers/device_adapter.hpp"

#include <algorithm>

namespace longreach {
namespace {

using adapter::HandleDatagram;

Vector3 vector(const double (&numbers)[3]) { return {numbers[0], numbers[1], numbers[2]}; }

HandleState measured(const HandleDatagram& d) {
  const auto has = [&d](HandleDatagram::Flag flag) { return (d.flags & flag) != 0; };
  HandleState s;
  s.p_MH = vector(d.position_m);
  s.velocity_m_per_s = vector(d.velocity_m_per_s);
  s.q_MH = Quaternion(d.orientation[0], d.orientation[1], d.orientation[2], d.orientation[3]).normalized();
  s.angular_rad_per_s = vector(d.angular_rad_per_s);
  s.buttons = {.mode = has(HandleDatagram::kMode),
               .scale_up = has(HandleDatagram::kScaleUp),
               .scale_down = has(HandleDatagram::kScaleDown),
               .clutch = has(HandleDatagram::kClutch),
               .kv_up = has(HandleDatagram::kKvUp),
               .kv_down = has(HandleDatagram::kKvDown)};
  s.held = has(HandleDatagram::kHeld);
  return s;
}

}  // namespace

HandleState DeviceAdapter::read(Time now) {
  const bool fresh = port_.receive(now);
  if (fresh && port_.ok()) measured_ = measured(port_.newest());
  measured_.ok = port_.ok();
  return measured_;
}

void DeviceAdapter::write(const Wrench& F_H_M) {
  adapter::WrenchDatagram out;
  if (F_H_M.force.allFinite() && F_H_M.moment.allFinite()) {
    out.flags = adapter::WrenchDatagram::kLive;
    std::copy_n(F_H_M.force.data(), 3, out.force_n);
    std::copy_n(F_H_M.moment.data(), 3, out.moment_nm);
  }
  port_.send(out);
}

}  // namespace longreach
