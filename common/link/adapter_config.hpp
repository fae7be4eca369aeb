#pragma once
// Adapter of a real device or robot. proto/config.proto defines meaning, unit and range under the same names.

#include <string>

namespace longreach {

struct AdapterConfig {
  std::string address;  // empty: no adapter
  double silence_s = 0.02;
};

}  // namespace longreach
