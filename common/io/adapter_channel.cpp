#include "common/io/adapter_channel.hpp"

#include <algorithm>

#include "common/io/address.hpp"
#include "common/wire/adapter_port.hpp"

namespace longreach {

std::unique_ptr<UdpChannel> open_adapter_channel(const AdapterConfig& config, const std::string& field) {
  if (config.address.empty()) return nullptr;
  const auto adapter = parse_udp_address(config.address);
  if (!config.remote && !adapter.address().is_loopback()) {
    throw AddressError(field + ".address = " + config.address +
                       " is not on this machine, and its datagrams are neither encrypted nor authenticated; "
                       "run the adapter here, or set " +
                       field + ".remote on a wire of its own");
  }
  const bool v6 = adapter.address().is_v6();
  const std::string listen = config.remote ? (v6 ? "[::]:0" : "0.0.0.0:0") : (v6 ? "[::1]:0" : "127.0.0.1:0");
  return std::make_unique<UdpChannel>(listen, config.address);
}

AdapterConfig told_in_time(AdapterConfig config, double rate_hz) {
  config.silence_s = std::max(config.silence_s - 1.0 / rate_hz, 0.5 * config.silence_s);
  return config;
}

std::string adapter_trouble(const AdapterFigures& figures, const std::string& device,
                            const std::string& address) {
  if (!figures.present || (!figures.silent && !figures.failed)) return "";
  const std::string adapter = "the adapter of the " + device + " at " + address;
  if (figures.failed) return adapter + " says that the " + device + " has failed; mend that, then engage";
  if (figures.accepted > 0) return adapter + " has gone silent; start it again, then engage";
  if (figures.malformed > 0)
    return adapter + " sends what is not of the protocol; `longreach adapter check` says what";
  return adapter + " does not answer; start it, then engage";
}

}  // namespace longreach
