#pragma once
// Fetches the data of the page from both sides, each in its own thread, and passes it on as JSON. Reconnects
// when a side is available again.
//
// From the master: {"frame": Frame of proto/control, "task": {...}} 60 times per second, or {"down": reason} if the master
// is not available. The task is the progress along the path of the scene, or null. From the slave: {"robot": ...,
// "scene": ..., "workspace_m": ...} of proto/config_slave.proto after connecting and after a restart of the slave,
// {"anchor": {"engagement": N, "position_m": [...], "rotation_rad": [...]}} at each engagement, and {"slave_down": reason}.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "deploy/cli/side_client.hpp"
#include "deploy/cli/task/path_progress.hpp"

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
  void take_scene(SideClient& slave);
  std::string task_json(const proto::Frame& frame);
  /// Waits for `time`. Returns false when the feed is being destroyed.
  bool rest(std::chrono::milliseconds time);

  const Options options_;
  const Backend backend_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<bool> ended_ = false;
  grpc::ClientContext* open_ = nullptr;
  std::optional<PathProgress> path_{};
  std::atomic<std::uint32_t> engagement_{0};  // engagement number of the master
  std::uint32_t anchored_ = 0;  // engagement of the known anchor; used by the thread of the slave only
  std::thread master_, slave_;
};

}  // namespace longreach
