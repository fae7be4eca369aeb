#pragma once
// Parameters of the adapter of a real device or robot. proto/config.proto defines the meaning, unit and range
// of each field under the same name.

#include <string>

namespace longreach {

struct AdapterConfig {
  std::string address;  // empty: no adapter
  double silence_s = 0.02;
};

}  // namespace longreach
