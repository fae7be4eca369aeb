#pragma once
// Opens the socket to the adapter of a real device or robot.

#include <memory>
#include <string>

#include "common/net/unix_channel.hpp"
#include "schema/config_common.hpp"

namespace longreach {

/// Returns null if no adapter is configured. Throws AddressError for an invalid address.
std::unique_ptr<UnixChannel> open_adapter_channel(const AdapterConfig& config);

/// Throws ConfigError if RPC is unencrypted (`insecure`) although an adapter for a real device or robot is
/// configured. `device` is "haptic device" or "robot".
void refuse_insecure(bool insecure, const AdapterConfig& config, const std::string& device);

/// Shortens silence_s by one tick of a loop at `rate_hz`, so that a timeout is reported by the last tick
/// before silence_s has passed instead of the first tick after it.
AdapterConfig with_prompt_timeout(AdapterConfig config, double rate_hz);

/// Describes what is wrong with an adapter and how to fix it; empty if there is no problem. `device` is
/// "haptic device" or "robot".
struct AdapterFigures;
std::string adapter_trouble(const AdapterFigures& figures, const std::string& device,
                            const std::string& address);

}  // namespace longreach
