#pragma once
// The interface between the loop and a pair of haptic devices: read the state of the handle, write the
// wrench. Implementations of read and write neither block nor allocate.

#include "common/core/time.hpp"
#include "schema/state_master.hpp"

namespace longreach {

class HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  /// Returns the state of the handle at `now`.
  virtual HandleState read(Time now) = 0;
  /// Sets the wrench on the hand, in M, which is held until the next write.
  virtual void write(const Wrench& F_H_M) = 0;
};

}  // namespace longreach
