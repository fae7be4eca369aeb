#pragma once
// An adapter of a device that breaks one rule of common/link/adapter_datagram.hpp, in a thread of the test.

#include <atomic>
#include <string>
#include <thread>

#include "tests/process/adapter_listener.hpp"

namespace longreach {

enum class Flaw {
  kNoWatchdog,  // goes on with the last wrench
  kMute,        // sends nothing while nobody talks
  kNoCount,     // every datagram has the number 1
  kNoEcho,
  kNotFinite,      // sends a number that is none now and then
  kShort,          // a byte too few, now and then
  kSlow,           // 100 a second
  kTakesAnything,  // of the right size
  kTakesOldNumbers,
  kTakesNoRestart,
  kNoWrench,     // tells no wrench
  kTakesAnyone,  // of whichever user
  kFailed        // never says that it works
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
