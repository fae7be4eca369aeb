#pragma once
// Data of the page, fetched from both sides by separate threads, as JSON. It reconnects when a side is
// available again.
//
// From the master: {"frame": proto/control's Frame} 60 times a second, or {"down": reason} if there is none.
// From the slave: {"robot": ..., "scene": ..., "workspace_m": ...} of proto/config at the first contact and
// after a restart, {"anchor": {"engagement": N, "position_m": [...], "rotation_rad": [...]}} at each
// engagement, and {"slave_down": reason}.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "deploy/cli/side_client.hpp"

namespace grpc {
class ClientContext;
}

namespace longreach {

class ViewFeed {
 public:
  struct Backend {
    std::function<void(std::string)> frame;
    std::function<void(const std::string& topic, std::string)> tell;
  };
  ViewFeed(const Options& options, Backend backend);
  ~ViewFeed();
  ViewFeed(const ViewFeed&) = delete;
  ViewFeed& operator=(const ViewFeed&) = delete;

 private:
  void follow();
  std::string read_frames();
  void ask_slave();
  double check_slave(SideClient& slave, double uptime_s);
  /// Returns false at the end.
  bool rest(std::chrono::milliseconds time);

  const Options options_;
  const Backend backend_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ended_ = false;
  grpc::ClientContext* open_ = nullptr;
  std::atomic<std::uint32_t> engagement_{0};  // of the master
  std::uint32_t anchored_ = 0;  // engagement of the known anchor; used by the thread of the slave only
  std::thread master_, slave_;
};

}  // namespace longreach
