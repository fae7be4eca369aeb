#include "common/net/adapter_channel.hpp"

#include <algorithm>

#include "common/config/config.hpp"
#include "common/wire/adapter_port.hpp"

namespace longreach {

std::unique_ptr<UnixChannel> open_adapter_channel(const AdapterConfig& config) {
  if (config.address.empty()) return nullptr;
  return std::make_unique<UnixChannel>(config.address);
}

void refuse_insecure(bool insecure, const AdapterConfig& config, const std::string& device) {
  if (!insecure || config.address.empty()) return;
  throw ConfigError("--insecure would let every user of this machine move the real " + device +
                    " given by --adapter: omit --insecure");
}

AdapterConfig with_prompt_timeout(AdapterConfig config, double rate_hz) {
  config.silence_s = std::max(config.silence_s - 1.0 / rate_hz, 0.5 * config.silence_s);
  return config;
}

std::string adapter_trouble(const AdapterFigures& figures, const std::string& device,
                            const std::string& address) {
  if (figures.unknown_peer)
    return "the program listening at " + address + " belongs to another user (uid " +
           std::to_string(*figures.unknown_peer) + ") and is ignored; start the adapter of the " + device +
           " as root or as the user that runs longreach";
  if (!figures.present || (!figures.silent && !figures.failed)) return "";
  const std::string adapter = "the adapter of the " + device + " at " + address;
  if (figures.failed)
    return adapter + " reports that the " + device + " failed; repair the " + device + ", then engage";
  if (figures.accepted > 0)
    return adapter + " stopped sending; if this persists, restart the adapter, then engage";
  if (figures.malformed > 0)
    return adapter + " sends invalid datagrams; run `longreach adapter check` for details";
  const std::string why = no_socket_there(unix_path(address));
  return adapter + " does not respond" + (why.empty() ? "" : ": " + why) + "; start the adapter, then engage";
}

}  // namespace longreach
