#pragma once
// The interface between the loop and a pair of haptic devices: read the handle, write the wrench.
// Implementations neither block nor allocate in read and write.

#include "common/core/time.hpp"
#include "master/devices/handle_state.hpp"

namespace longreach {

class HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  virtual HandleState read(Time now) = 0;
  /// Wrench on the hand, in M, held until the next write.
  virtual void write(const Wrench& F_H_M) = 0;
};

}  // namespace longreach
