#pragma once
// Parameters of the adapter of a real device or robot. Each field is documented under the same name in
// proto/config.proto.

#include <string>

namespace longreach {

struct AdapterConfig {
  std::string address;  // empty: no adapter
  double silence_s = 0.02;
};

}  // namespace longreach
