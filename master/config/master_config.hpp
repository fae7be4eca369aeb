#pragma once
// All parameters of the master as plain values. Each field is documented under the same name in
// proto/config.proto.

#include <algorithm>
#include <cstdint>
#include <string>

#include "common/core/loop_config.hpp"
#include "common/link/adapter_config.hpp"
#include "common/link/impairment.hpp"
#include "master/config/device_config.hpp"
#include "master/config/mapping_config.hpp"
#include "master/config/rendering_config.hpp"

namespace longreach {

struct MasterLinkConfig {
  std::string slave = "127.0.0.1:47001";
  std::string listen = "0.0.0.0:0";
  double send_hz = 300.0;
  ImpairmentConfig impairment{};
  std::string slave_rpc;
  double budget_kbit_per_s = 0.0;
};

/// Returns the rate at which commands are sent, Hz: the requested rate, limited by the bandwidth budget. A
/// datagram counts as 128 bytes, headers included.
inline double sent_hz(const MasterLinkConfig& link) {
  constexpr double kbit = 1e-3 * 8.0 * 128.0;
  return link.budget_kbit_per_s > 0.0 ? std::min(link.send_hz, link.budget_kbit_per_s / kbit) : link.send_hz;
}

enum class Presence : std::uint8_t { kIgnore, kHold };

struct MasterSafetyConfig {
  double silence_s = 0.5;
  double resume_s = 1.0;
  bool engage_at_start = false;
  Presence presence = Presence::kIgnore;
  double presence_s = 0.3;
  double gap_s = 0.1;
  double delay_rise_max_s = 1.0;
};

struct MasterConfig {
  MasterLinkConfig link{};
  LoopConfig loop{};
  std::string device_file = "devices/desktop.txtpb";
  DeviceConfig device{};
  HandConfig hand{};
  OperatorConfig operator_{};  // called `operator` in the schema
  MappingConfig mapping{};
  RenderingConfig rendering{};
  MasterSafetyConfig safety{};
  RpcServerConfig rpc{};
  Accuracy accuracy = Accuracy::kBalanced;
  AdapterConfig device_adapter{};
};

}  // namespace longreach
