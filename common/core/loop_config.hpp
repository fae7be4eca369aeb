#pragma once
// Parameters that both programs share. Each field is documented under the same name in proto/config.proto.

#include <cstdint>
#include <string>

namespace longreach {

/// Trade-off between speed and accuracy. When a configuration is read, this field sets other fields
/// (common/config/accuracy.cpp).
enum class Accuracy : std::uint8_t { kFast, kBalanced, kExact };

struct LoopConfig {
  double rate_hz = 1000.0;
  std::uint32_t priority = 50;
  bool lock_memory = true;
};

struct RpcServerConfig {
  std::string listen;  // empty: 127.0.0.1:47010 (master), 127.0.0.1:47020 (slave)
};

}  // namespace longreach
