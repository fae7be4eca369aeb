#pragma once
// Absolute deadlines for periodic updates, so that the period does not drift. Deadlines that a slow caller
// has missed are skipped.

#include <chrono>

namespace longreach {

class Pace {
 public:
  explicit Pace(double rate_hz)
      : period_(std::chrono::duration_cast<std::chrono::steady_clock::duration>(
            std::chrono::duration<double>(1.0 / rate_hz))),
        due_(std::chrono::steady_clock::now()) {}
  [[nodiscard]] std::chrono::steady_clock::time_point due() const { return due_; }
  void advance() {
    due_ += period_;
    const auto now = std::chrono::steady_clock::now();
    if (now > due_) due_ += (now - due_) / period_ * period_;
  }

 private:
  std::chrono::steady_clock::duration period_;
  std::chrono::steady_clock::time_point due_;
};

}  // namespace longreach
