#pragma once
// A fake backend of a side. It records all requests and accepts them by default.

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/config/config.hpp"
#include "common/rpc/control_backend.hpp"

namespace longreach {

class FakeBackend : public ControlBackend {
 public:
  explicit FakeBackend(std::string side) : side_(std::move(side)) {
    config_.mutable_estimator()->set_forgetting(0.99);
  }

  /// Makes all further changes fail with this refusal; with std::nullopt they are accepted again.
  void refuse(std::optional<Refusal> refusal) {
    const std::lock_guard lock(mutex_);
    refusal_ = std::move(refusal);
  }
  [[nodiscard]] std::vector<std::string> calls() const {
    const std::lock_guard lock(mutex_);
    return calls_;
  }
  [[nodiscard]] proto::Impairment present_link() const {
    const std::lock_guard lock(mutex_);
    return link_;
  }
  void put_link(const proto::Impairment& link) {
    const std::lock_guard lock(mutex_);
    link_ = link;
  }
  /// Adds a mesh file of this size to the configuration.
  void put_mesh(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    config_.mutable_scene()->mutable_bodies()->add_file()->set_text(std::string(bytes, 'v'));
  }
  /// If `block` is true, calls that change the configuration block.
  void block_changes(bool block) { blocked_ = block; }
  /// Returns the maximum number of concurrent changes so far.
  [[nodiscard]] int overlap() const { return overlap_; }

  proto::Status status() override {
    const std::lock_guard lock(mutex_);
    proto::Status status;
    status.set_side(side_);
    status.set_state("Engaged");
    status.set_scale(scale_);
    status.mutable_link()->set_rtt_known(true);
    status.mutable_link()->set_rtt_s(1.3);
    *status.mutable_impairment() = link_;
    proto::NamedCount& zero = *status.add_counters();
    zero.set_name("late_ticks");
    zero.set_count(0);
    proto::NamedCount& some = *status.add_counters();
    some.set_name("rejected_replay");
    some.set_count(7);
    return status;
  }
  std::shared_ptr<const google::protobuf::Message> config() override {
    const std::lock_guard lock(mutex_);
    return std::make_shared<const proto::SlaveConfig>(config_);
  }
  std::shared_ptr<const google::protobuf::Message> start_config() override { return config(); }
  const Origins& start_origins() override { return origins; }
  Origins origins{};
  std::optional<Refusal> set_config(const Assignments& assignments) override {
    while (blocked_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const Inside inside(*this);
    proto::SlaveConfig wanted = config_;
    try {
      for (const auto& [path, value] : assignments) set_field(wanted, path, value);
      validate(wanted);
    } catch (const ConfigError& error) {
      return Refusal{Refusal::Kind::kInvalid, error.what()};
    }
    return change("set_config", [&] { config_ = wanted; });
  }
  proto::Impairment link() override {
    const std::lock_guard lock(mutex_);
    return link_;
  }
  std::optional<Refusal> set_link(const proto::Impairment& impairment) override {
    const Inside inside(*this);
    return change("set_link", [&] { link_ = impairment; });
  }
  std::variant<std::string, Refusal> run(const proto::Action& action) override {
    const Inside inside(*this);
    const auto* which = proto::Action::descriptor()->FindFieldByNumber(action.action_case());
    std::string call = which->name();
    if (action.has_mode()) call += " " + proto::MotionMode_Name(action.mode());
    if (action.has_start_recording()) call += " " + action.start_recording().name();
    if (auto refusal = change(call, [&] { scale_ = action.has_scale() ? action.scale() : scale_; }))
      return *std::move(refusal);
    if (action.has_start_recording())
      return "/recordings/" + action.start_recording().name() + "-" + side_ + ".mcap";
    if (action.has_stop_recording()) return "/recordings/x-" + side_ + ".mcap: 1.5 s, 0.2 MB";
    return call;
  }
  std::optional<Refusal> stop() override {
    const std::lock_guard lock(mutex_);
    return change("stop", [] {});
  }
  std::variant<proto::OpenSessionResponse, Refusal> open_session(const proto::OpenSessionRequest& request,
                                                                 const std::string&) override {
    const Inside inside(*this);
    if (auto refusal = change(request.take() ? "open_session take" : "open_session", [] {}))
      return *std::move(refusal);
    proto::OpenSessionResponse response;
    response.set_session(present_session_);
    if (request.session() != present_session_) response.set_secret(std::string(32, 's'));
    return response;
  }
  std::optional<Refusal> close_session(std::uint64_t session) override {
    const Inside inside(*this);
    return change("close_session " + std::to_string(session), [] {});
  }
  /// Sets the number of the session that open_session returns. A caller that already has this session keeps
  /// it.
  void put_session(std::uint64_t number) {
    const std::lock_guard lock(mutex_);
    present_session_ = number;
  }

 private:
  class Inside {
   public:
    explicit Inside(FakeBackend& backend) : backend_(backend), lock_(backend.mutex_, std::defer_lock) {
      const int now = ++backend_.inside_;
      if (now > backend_.overlap_) backend_.overlap_ = now;
      std::this_thread::sleep_for(std::chrono::microseconds(200));  // gives a concurrent call time to enter
      lock_.lock();
    }
    ~Inside() { --backend_.inside_; }
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;

   private:
    FakeBackend& backend_;
    std::unique_lock<std::mutex> lock_;
  };

  template <class Action>
  std::optional<Refusal> change(const std::string& call, Action action) {
    calls_.push_back(call);
    if (refusal_) return refusal_;
    action();
    return {};
  }

  const std::string side_;
  mutable std::mutex mutex_;
  std::atomic<int> inside_ = 0;
  std::atomic<int> overlap_ = 0;
  std::atomic<bool> blocked_ = false;
  std::vector<std::string> calls_;  // recorded changes, in order
  std::optional<Refusal> refusal_;
  proto::SlaveConfig config_;
  proto::Impairment link_;
  double scale_ = 0.5;
  std::uint64_t present_session_ = 77;
};

}  // namespace longreach
