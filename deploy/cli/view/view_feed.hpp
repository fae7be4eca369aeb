#pragma once
// What the page shows, fetched from both sides by threads of its own, as JSON. Connects again whenever a side
// comes back.
//
// From the master: {"frame": proto/control's Frame} 60 times a second, or {"down": why} when there is none.
// From the slave: {"robot": ..., "scene": ..., "workspace_m": ...} of proto/config when it is first heard and
// when it has restarted, and
// {"anchor": {"engagement": N, "position_m": [...], "rotation_rad": [...]}} at each engagement;
// {"slave_down": why}.

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
  /// False at the end.
  bool rest(std::chrono::milliseconds time);

  const Options options_;
  const Backend backend_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ended_ = false;
  grpc::ClientContext* open_ = nullptr;
  std::atomic<std::uint32_t> engagement_{0};  // the master's
  std::uint32_t anchored_ = 0;                // engagement whose anchor is known; the slave's thread alone
  std::thread master_, slave_;
};

}  // namespace longreach
