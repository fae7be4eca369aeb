#pragma once
// The socket to an adapter of a real device or robot.

#include <memory>
#include <string>

#include "common/link/adapter_config.hpp"
#include "common/net/unix_channel.hpp"

namespace longreach {

/// Null: there is no adapter. Throws AddressError.
std::unique_ptr<UnixChannel> open_adapter_channel(const AdapterConfig& config);

/// RPC that everybody may use moves nothing real. Throws ConfigError. `device`: "haptic device" or "robot".
void refuse_insecure(bool insecure, const AdapterConfig& config, const std::string& device);

/// Of a loop of so many ticks a second: the last tick within silence_s tells that silence, not the first
/// after it.
AdapterConfig with_prompt_timeout(AdapterConfig config, double rate_hz);

/// What is wrong with an adapter and what to do, or empty. `device`: "haptic device" or "robot".
struct AdapterFigures;
std::string adapter_trouble(const AdapterFigures& figures, const std::string& device,
                            const std::string& address);

}  // namespace longreach
