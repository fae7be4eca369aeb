#pragma once
// A real pair of haptic devices, connected through an adapter, the program that drives the hardware
// (common/link/adapter_datagram.hpp). If this side stops sending, the watchdog of the adapter releases the
// handle. If the adapter stops sending, or reports a failure of the device, this side reports a device fault.

#include "common/wire/adapter_port.hpp"
#include "master/devices/haptic_device.hpp"
#include "schema/config_common.hpp"

namespace longreach {

class DeviceAdapter : public HapticDevice {
 public:
  /// `channel` must outlive this object. `session` is a non-zero number that is chosen randomly at each
  /// start.
  DeviceAdapter(Channel& channel, const AdapterConfig& config, std::uint64_t session)
      : port_(channel, session, config.silence_s) {}

  /// Returns the state from the newest datagram. Before the first datagram, or if none has arrived for
  /// silence_s, this is the state of a failed device.
  HandleState read(Time now) override;
  /// Sends a wrench to the device. If the wrench is not finite, no wrench is rendered.
  void write(const Wrench& F_H_M) override;
  /// Sends a datagram without a wrench, to establish the connection before the first tick.
  void greet() { port_.send({}); }

  [[nodiscard]] const AdapterFigures& figures() const { return port_.figures(); }

 private:
  AdapterPort<adapter::WrenchDatagram, adapter::HandleDatagram> port_;
  HandleState measured_{.held = false, .ok = false};
};

}  // namespace longreach
