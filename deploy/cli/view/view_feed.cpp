#include "deploy/cli/view/view_feed.hpp"

#include <grpcpp/grpcpp.h>

#include <array>
#include <chrono>

#include "common/text/number_text.hpp"
#include "deploy/cli/frames.hpp"
#include "deploy/cli/json_text.hpp"

namespace longreach {
namespace {

constexpr auto kFeedRetryAfter = std::chrono::milliseconds(500);
constexpr auto kSlavePeriod = std::chrono::milliseconds(1000);
/// While the anchor of the engagement is missing.
constexpr auto kAnchorPeriod = std::chrono::milliseconds(100);
constexpr double kFrameHz = 60.0;

std::string reported(const char* name, const std::string& sentence) {
  return std::string("{\"") + name + "\":" + (sentence.empty() ? "null" : json_string(sentence)) + "}";
}

template <class Field>
std::string vector_json(const Field& numbers) {
  std::string text = "[";
  for (const double number : numbers) text += (text.size() > 1 ? "," : "") + std::to_string(number);
  return text + "]";
}

}  // namespace

ViewFeed::ViewFeed(const Options& options, Backend backend)
    : options_(options), backend_(std::move(backend)) {
  master_ = std::thread([this] { follow(); });
  slave_ = std::thread([this] { ask_slave(); });
}

ViewFeed::~ViewFeed() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    if (open_ != nullptr) open_->TryCancel();
    changed_.notify_all();
  }
  master_.join();
  slave_.join();
}

bool ViewFeed::rest(std::chrono::milliseconds time) {
  std::unique_lock lock(mutex_);
  return !changed_.wait_for(lock, time, [this] { return ended_.load(); });
}

void ViewFeed::follow() {
  do {
    backend_.tell("down", reported("down", read_frames()));
  } while (rest(kFeedRetryAfter));
}

/// Reads until the stream ends. Returns the reason.
std::string ViewFeed::read_frames() {
  bool first = true;
  return follow_frames(
      options_, kFrameHz, ended_,
      [this](grpc::ClientContext* context) {
        const std::lock_guard lock(mutex_);
        open_ = ended_ ? nullptr : context;
        return !ended_;
      },
      [&](const proto::Frame& frame) {
        if (first) backend_.tell("down", reported("down", ""));
        first = false;
        engagement_ = frame.view().engagement();
        backend_.frame("{\"frame\":" + json_object(frame) + ",\"task\":" + task_json(frame) + "}");
        return true;
      });
}

void ViewFeed::ask_slave() {
  std::optional<SideClient> slave;
  double uptime_s = -1.0;
  do {
    try {
      if (!slave) slave.emplace(Side::kSlave, options_);
      uptime_s = check_slave(*slave, uptime_s);
      backend_.tell("slave_down", reported("slave_down", ""));
    } catch (const std::exception& error) {
      uptime_s = -1.0;
      backend_.tell("slave_down", reported("slave_down", error.what()));
    }
  } while (rest(anchored_ == engagement_ ? kSlavePeriod : kAnchorPeriod));
}

void ViewFeed::take_scene(SideClient& slave) {
  const auto robot = slave.part<proto::Robot>("robot");
  const auto scene = slave.part<proto::Scene>("scene");
  backend_.tell("scene", "{\"robot\":" + json_object(robot) + ",\"scene\":" + json_object(scene) +
                             ",\"workspace_m\":" + slave.get("command.workspace_m") + "}");
  std::optional<PathProgress> path;
  try {
    path = path_of(robot, scene);
  } catch (const std::invalid_argument&) {
    // Of a slave of another version: the page shows the rest.
  }
  const std::lock_guard lock(mutex_);
  path_ = path;
}

std::string ViewFeed::task_json(const proto::Frame& frame) {
  const std::lock_guard lock(mutex_);
  if (!path_ || !frame.view().far_known()) return "null";
  path_->step(frame.seconds(), tool_m(frame));
  constexpr std::array kPhases = {"AWAY", "READY", "UNDERWAY", "DONE"};
  const PathFigures figures = path_->figures();
  return std::string("{\"phase\":\"") + kPhases[static_cast<std::size_t>(path_->phase())] +
         "\",\"time_s\":" + format_number(figures.time_s) +
         ",\"error_m\":" + format_number(path_->error_m()) +
         ",\"mean_error_m\":" + format_number(figures.mean_error_m) +
         ",\"max_error_m\":" + format_number(figures.max_error_m) +
         ",\"passed\":" + std::to_string(figures.passed) + ",\"balls\":" + std::to_string(path_->balls()) +
         "}";
}

/// Returns the uptime of the slave.
double ViewFeed::check_slave(SideClient& slave, double uptime_s) {
  const proto::Status status = slave.status();
  // The slave has restarted, perhaps with another robot.
  if (uptime_s < 0.0 || status.uptime_s() < uptime_s) {
    anchored_ = 0;
    take_scene(slave);
  }
  if (status.engagement() == engagement_ && status.engagement() != anchored_ && status.anchor_m_size() == 3) {
    anchored_ = status.engagement();
    backend_.tell("anchor", "{\"anchor\":{\"engagement\":" + std::to_string(anchored_) +
                                ",\"position_m\":" + vector_json(status.anchor_m()) +
                                ",\"rotation_rad\":" + vector_json(status.anchor_rad()) + "}}");
  }
  return status.uptime_s();
}

}  // namespace longreach
