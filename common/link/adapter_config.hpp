#pragma once
// A real device or robot behind an adapter. Meaning, unit and range: proto/config.proto; the same names.

#include <string>

namespace longreach {

struct AdapterConfig {
  std::string address;  // empty: there is none
  double silence_s = 0.02;
};

}  // namespace longreach
