#pragma once
// Operations of the slave for RPC clients: queries, tighter limits, an artificial impairment of the link, and
// a stop. Engagement, mode and scale can be changed only at the master.

#include <chrono>
#include <mutex>

#include "common/rpc/control_backend.hpp"
#include "common/rpc/recording_answers.hpp"
#include "common/rpc/side_config.hpp"
#include "slave/program/slave_shell.hpp"

namespace longreach {

/// Returns the reason why the robot cannot be engaged, and a remedy; the string is empty if it can be
/// engaged.
std::string robot_trouble(const SlaveView& view);

class SlaveService : public ControlBackend {
 public:
  /// `config` is the loaded configuration with the contents of its files; its limits are upper bounds for
  /// later changes.
  SlaveService(SlaveShell& shell, const proto::SlaveConfig& config, RecordingPlace recordings = {},
               Origins origins = {});

  proto::Status status() override;
  std::shared_ptr<const google::protobuf::Message> config() override;
  std::shared_ptr<const google::protobuf::Message> start_config() override;
  const Origins& start_origins() override { return origins_; }
  std::optional<Refusal> set_config(const Assignments& assignments) override;
  proto::Impairment link() override;
  std::optional<Refusal> set_link(const proto::Impairment& impairment) override;
  std::variant<std::string, Refusal> run(const proto::Action& action) override;
  std::optional<Refusal> stop() override;
  std::variant<proto::OpenSessionResponse, Refusal> open_session(const proto::OpenSessionRequest& request,
                                                                 const std::string& caller) override;
  std::optional<Refusal> close_session(std::uint64_t session) override;

  /// Starts a recording. Call this before the loop starts, because a replay requires that the first tick be
  /// recorded. Throws RecordingError.
  void record_from_start(const std::string& file, double max_mb);

  /// Address of the master that controls the robot; empty if there is none.
  [[nodiscard]] std::string lease() const;

  /// Returns the newest snapshot of the loop. May be called from any thread except that of the loop.
  SlaveSnapshot snapshot();

 private:
  std::variant<std::string, Refusal> start_recording(const std::string& name, double max_mb);
  Refusal occupied(const std::string& caller);
  void set_lease(const std::string& holder);

  SideRecording<SlaveRecordBuffer>::Request recording_request(double max_mb) const;
  /// Passes a record buffer to the loop. Returns false if the loop did not respond.
  bool attach(SlaveRecordBuffer* record_buffer);

  SlaveShell& shell_;
  SideConfig<proto::SlaveConfig> config_;
  const Origins origins_;
  std::uint32_t config_number_ = 0;  // number of the last configuration passed to the loop
  RecordingPlace recordings_;
  SideRecording<SlaveRecordBuffer> recording_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::mutex reading_;  // protects reading of snapshots
  mutable std::mutex leasing_;
  std::string lease_;
  std::string refused_;  // address of the last master that was refused
};

}  // namespace longreach
