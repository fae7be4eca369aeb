#pragma once
// The configurations of a side for its RPC threads: the initial one, and the current one, which is replaced
// as a whole. Readers do not wait while a change is prepared.

#include <memory>
#include <mutex>
#include <utility>

namespace longreach {

template <class Config>
class SideConfig {
 public:
  explicit SideConfig(const Config& start)
      : start_(std::make_shared<const Config>(start)), present_(start_) {}

  [[nodiscard]] std::shared_ptr<const Config> start() const { return start_; }
  [[nodiscard]] std::shared_ptr<const Config> present() const {
    const std::lock_guard lock(mutex_);
    return present_;
  }
  void put(Config config) {
    auto next = std::make_shared<const Config>(std::move(config));
    const std::lock_guard lock(mutex_);
    present_.swap(next);
  }

 private:
  const std::shared_ptr<const Config> start_;
  mutable std::mutex mutex_;  // protects the pointer
  std::shared_ptr<const Config> present_;
};

}  // namespace longreach
