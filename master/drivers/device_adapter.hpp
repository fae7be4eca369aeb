#pragma once
// A real pair of haptic devices, connected by its adapter, the program that drives the hardware
// (common/link/adapter_datagram.hpp). The watchdog of the adapter releases the handle when this side is
// silent; silence of the adapter, or a reported failure of the device, is a fault of this side.

#include "common/link/adapter_config.hpp"
#include "common/wire/adapter_port.hpp"
#include "master/devices/haptic_device.hpp"

namespace longreach {

class DeviceAdapter : public HapticDevice {
 public:
  /// `channel` must outlive it. `session`: random at each start, not 0.
  DeviceAdapter(Channel& channel, const AdapterConfig& config, std::uint64_t session)
      : port_(channel, session, config.silence_s) {}

  /// Returns the content of the newest datagram, with its time of arrival. Before the first datagram: a
  /// failed device.
  HandleState read(Time now) override;
  /// A wrench that is not finite counts as no wrench.
  void write(const Wrench& F_H_M) override;
  /// Contacts the adapter before the first wrench.
  void greet() { port_.send({}); }

  [[nodiscard]] const AdapterFigures& figures() const { return port_.figures(); }

 private:
  AdapterPort<adapter::WrenchDatagram, adapter::HandleDatagram> port_;
  HandleState measured_{.held = false, .ok = false};
};

}  // namespace longreach
