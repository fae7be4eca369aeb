#pragma once
// A device adapter that violates one rule of common/link/adapter_datagram.hpp. It runs in a thread of the
// test.

#include <atomic>
#include <string>
#include <thread>

#include "tests/process/adapter_listener.hpp"

namespace longreach {

enum class Flaw {
  kNoWatchdog,  // keeps applying the last wrench
  kMute,        // sends nothing until it receives something
  kNoCount,     // every datagram has the sequence number 1
  kNoEcho,
  kNotFinite,      // sometimes sends NaN
  kShort,          // sometimes sends one byte too few
  kSlow,           // sends at 100 Hz
  kTakesAnything,  // accepts any datagram of the right size
  kTakesOldNumbers,
  kTakesNoRestart,
  kNoWrench,     // does not report the wrench
  kTakesAnyone,  // accepts connections from any user
  kFailed        // never reports that it is operational
};

class BrokenAdapter {
 public:
  explicit BrokenAdapter(Flaw flaw);
  ~BrokenAdapter();
  BrokenAdapter(const BrokenAdapter&) = delete;
  BrokenAdapter& operator=(const BrokenAdapter&) = delete;
  [[nodiscard]] std::string address() const { return listener_.address(); }

 private:
  void run();

  Flaw flaw_;
  AdapterListener listener_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace longreach
