#pragma once
// Operations of the master for RPC clients and keys: status, configuration, impairment of the link, mode,
// scale, engage, stop, sessions and recordings.

#include <chrono>
#include <mutex>

#include "common/rpc/control_backend.hpp"
#include "common/rpc/recording_answers.hpp"
#include "common/rpc/side_config.hpp"
#include "master/console/situation.hpp"
#include "master/program/master_shell.hpp"

namespace longreach {

class MasterService : public ControlBackend {
 public:
  /// `config` is the loaded configuration with all referenced files resolved. Its limits are upper bounds for
  /// later changes.
  MasterService(MasterShell& shell, const proto::MasterConfig& config, RecordingPlace recordings = {},
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

  /// Starts a recording. Call this before the loop starts, because a replay requires that the first tick is
  /// recorded. Throws RecordingError.
  void record_from_start(const std::string& file, double max_mb);

  /// Returns the newest snapshot of the loop. May be called from any thread except the loop thread.
  MasterSnapshot snapshot();
  /// Passes requests to the loop. Returns the reason if they are refused. May be called from any thread
  /// except the loop thread.
  std::optional<Refusal> request(const OperatorRequests& requests);
  /// Passes a session to the loop. Returns false if the loop did not respond. May be called from any thread
  /// except the loop thread.
  bool adopt(const Session& session);
  /// Returns why there is no session with the slave, or another problem with the link or the hand; empty if
  /// there is no problem.
  std::string trouble();
  /// Sets the text that trouble() returns, and the address of the other master that has control of the robot.
  /// Empty means none.
  void put_trouble(const std::string& trouble, const std::string& taken_by);
  /// What is shown to the operator.
  Shown shown();
  void put_shown(const Shown& shown);

 private:
  std::optional<Refusal> engage();
  std::variant<std::string, Refusal> start_recording(const std::string& name, double max_mb);
  SideRecording<MasterRecordBuffer>::Request recording_request(double max_mb) const;
  /// Passes a record buffer to the loop. Returns false if the loop did not respond.
  bool attach(MasterRecordBuffer* record_buffer);

  MasterShell& shell_;
  SideConfig<proto::MasterConfig> config_;
  const Origins origins_;
  std::uint32_t config_number_ = 0;  // number of the last configuration passed to the loop
  RecordingPlace recordings_;
  SideRecording<MasterRecordBuffer> recording_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::mutex reading_;  // serialises readers of snapshots
  std::mutex troubling_;
  std::string trouble_, taken_by_;
  Shown shown_{};
};

}  // namespace longreach
