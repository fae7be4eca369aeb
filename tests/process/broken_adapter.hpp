#pragma once
// A device adapter that violates one rule of common/link/adapter_datagram.hpp, in a thread of the test.

#include <atomic>
#include <string>
#include <thread>

#include "tests/process/adapter_listener.hpp"

namespace longreach {

enum class Flaw {
  kNoWatchdog,  // continues with the last wrench
  kMute,        // sends nothing unless it receives
  kNoCount,     // every datagram has the number 1
  kNoEcho,
  kNotFinite,      // sends NaN sometimes
  kShort,          // sends one byte too few sometimes
  kSlow,           // sends at 100 Hz
  kTakesAnything,  // accepts any datagram of the right size
  kTakesOldNumbers,
  kTakesNoRestart,
  kNoWrench,     // does not report the wrench
  kTakesAnyone,  // accepts any user
  kFailed        // never reports that it works
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
