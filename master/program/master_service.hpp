#pragma once
// Operations of the master for RPC clients and keys: queries, settings, impairment, mode and scale, engage,
// stop.

#include <chrono>
#include <mutex>

#include "common/rpc/control_backend.hpp"
#include "common/rpc/recording_answers.hpp"
#include "common/rpc/side_config.hpp"
#include "master/program/master_shell.hpp"

namespace longreach {

class MasterService : public ControlBackend {
 public:
  /// `config`: as loaded, files resolved; its limits are upper bounds for later changes.
  MasterService(MasterShell& shell, const proto::MasterConfig& config, RecordingPlace recordings = {});

  proto::Status status() override;
  std::shared_ptr<const google::protobuf::Message> config() override;
  std::shared_ptr<const google::protobuf::Message> start_config() override;
  std::optional<Refusal> set_config(const Assignments& assignments) override;
  proto::Impairment link() override;
  std::optional<Refusal> set_link(const proto::Impairment& impairment) override;
  std::optional<Refusal> set_mode(proto::Mapping::Mode mode) override;
  std::optional<Refusal> set_scale(double scale) override;
  std::optional<Refusal> engage() override;
  std::optional<Refusal> stop() override;
  std::variant<proto::OpenSessionResponse, Refusal> open_session(const proto::OpenSessionRequest& request,
                                                                 const std::string& caller) override;
  std::optional<Refusal> close_session(std::uint64_t session) override;
  std::variant<std::string, Refusal> start_recording(const std::string& name, double max_mb) override;
  std::variant<std::string, Refusal> stop_recording() override;

  /// Call it before the loop starts, so that its first tick is recorded, as a replay requires. Throws
  /// RecordingError.
  void record_from_start(const std::string& file, double max_mb);

  /// Newest snapshot of the loop; callable from any thread except the loop's.
  MasterSnapshot snapshot();
  /// Passes requests of keys to the loop; callable from any thread except the loop's.
  std::optional<Refusal> request(const OperatorRequests& requests);
  /// Passes a session to the loop; false: it did not respond. Callable from any thread except the loop's.
  bool adopt(const Session& session);
  /// Returns why there is no session; empty: there is one.
  std::string trouble();
  /// Sets why there is no session, and the address of the master that has control of the robot; empty: none.
  void put_trouble(const std::string& trouble, const std::string& taken_by);

 private:
  SideRecording<MasterRecordBuffer>::Request recording_request(double max_mb) const;
  /// Passes a record buffer to the loop; false: it did not respond.
  bool attach(MasterRecordBuffer* record_buffer);

  MasterShell& shell_;
  SideConfig<proto::MasterConfig> config_;
  std::uint32_t config_number_ = 0;  // of the configurations passed to the loop
  RecordingPlace recordings_;
  SideRecording<MasterRecordBuffer> recording_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::mutex reading_;  // for readers of snapshots
  std::mutex troubling_;
  std::string trouble_, taken_by_;
};

}  // namespace longreach
