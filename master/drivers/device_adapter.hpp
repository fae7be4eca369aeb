#pragma once
// A real pair of haptic devices behind its adapter: the program that speaks to the hardware
// (common/link/adapter_datagram.hpp). Its own watchdog lets the handle go when this side is silent; silence
// of the adapter, or its word that the device has failed, is a fault here.

#include "common/link/adapter_config.hpp"
#include "common/wire/adapter_port.hpp"
#include "master/devices/haptic_device.hpp"

namespace longreach {

class DeviceAdapter : public HapticDevice {
 public:
  /// `channel` must outlive it. `session`: drawn anew at each start, not 0.
  DeviceAdapter(Channel& channel, const AdapterConfig& config, std::uint64_t session)
      : port_(channel, session, config.silence_s) {}

  /// What the newest datagram says, at the time when it has come. Before the first: a device that has failed.
  HandleState read(Time now) override;
  /// A wrench that is not finite is none.
  void write(const Wrench& F_H_M) override;
  /// Tells the adapter that somebody is there, before the first wrench.
  void greet() { port_.send({}); }

  [[nodiscard]] const AdapterFigures& figures() const { return port_.figures(); }

 private:
  AdapterPort<adapter::WrenchDatagram, adapter::HandleDatagram> port_;
  HandleState measured_{.held = false, .ok = false};
};

}  // namespace longreach
