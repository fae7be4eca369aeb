#include "deploy/cli/view/view_feed.hpp"

#include <google/protobuf/text_format.h>
#include <grpcpp/grpcpp.h>

#include <chrono>
#include <optional>

#include "deploy/cli/json_text.hpp"
#include "proto/control.grpc.pb.h"

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

/// Returns a part of the slave's configuration as JSON.
template <class Part>
std::string part_json(SideClient& slave, const char* path) {
  Part part;
  if (!google::protobuf::TextFormat::ParseFromString(slave.get(path), &part))
    throw SideError(SideError::Kind::kRefused,
                    "the slave's " + std::string(path) + " is invalid: run the same version of all programs");
  return json_object(part);
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
  try {
    const auto connection = connection_to(Side::kMaster, options_);
    const auto stub = proto::Desk::NewStub(connection->channel());
    const auto progress = connection->connect(options_.timeout_s, ended_);
    grpc::ClientContext context;
    if (!progress.connected) context.set_deadline(progress.call_until);
    {
      const std::lock_guard lock(mutex_);
      if (ended_) return "";
      open_ = &context;
    }
    proto::FollowRequest request;
    request.set_rate_hz(kFrameHz);
    const auto stream = stub->Follow(&context, request);
    bool first = true;
    for (proto::Frame frame; stream->Read(&frame); first = false) {
      if (first) backend_.tell("down", reported("down", ""));
      engagement_ = frame.view().engagement();
      backend_.frame("{\"frame\":" + json_object(frame) + "}");
    }
    const grpc::Status end = stream->Finish();
    const std::lock_guard lock(mutex_);
    open_ = nullptr;
    return failure(Side::kMaster, options_, context, end, progress).what();
  } catch (const std::exception& error) {
    return error.what();
  }
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

/// Returns the uptime of the slave.
double ViewFeed::check_slave(SideClient& slave, double uptime_s) {
  const proto::Status status = slave.status();
  // The slave has restarted, perhaps with another robot.
  if (uptime_s < 0.0 || status.uptime_s() < uptime_s) {
    anchored_ = 0;
    backend_.tell("scene", "{\"robot\":" + part_json<proto::Robot>(slave, "robot") +
                               ",\"scene\":" + part_json<proto::Scene>(slave, "scene") +
                               ",\"workspace_m\":" + slave.get("command.workspace_m") + "}");
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
