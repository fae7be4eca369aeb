#pragma once
// Every parameter of the master as plain values. Meaning, unit, default and range: proto/config.proto; the
// same names.

#include <string>

#include "common/core/loop_config.hpp"
#include "common/link/impairment.hpp"
#include "master/devices/device_config.hpp"
#include "master/mapping/mapping_config.hpp"
#include "master/rendering/rendering_config.hpp"

namespace longreach {

struct MasterLinkConfig {
  std::string slave = "127.0.0.1:47001";
  std::string listen = "0.0.0.0:0";
  double send_hz = 200.0;
  ImpairmentConfig impairment{};
  std::string slave_rpc;
};

struct MasterSafetyConfig {
  double silence_s = 0.5;
  double resume_s = 1.0;
  bool engage_at_start = false;
};

struct MasterConfig {
  MasterLinkConfig link{};
  LoopConfig loop{};
  std::string device_file = "devices/desktop.txtpb";
  DeviceConfig device{};
  HandConfig hand{};
  OperatorConfig operator_{};  // `operator` in the schema
  MappingConfig mapping{};
  RenderingConfig rendering{};
  MasterSafetyConfig safety{};
  RpcServerConfig rpc{};
};

}  // namespace longreach
