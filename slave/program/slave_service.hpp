#pragma once
// What RPC clients may do at the slave: look, tighten, impair, stop. Engagement, mode and scale are the
// master's.

#include <chrono>
#include <mutex>

#include "common/rpc/control_backend.hpp"
#include "common/rpc/recording_answers.hpp"
#include "common/rpc/side_config.hpp"
#include "slave/program/slave_shell.hpp"

namespace longreach {

/// Why the robot cannot be engaged and what to do, or empty.
std::string robot_trouble(const SlaveView& view);

class SlaveService : public ControlBackend {
 public:
  /// `config`: as loaded, files resolved; its limits are the ceiling for what may be set later.
  SlaveService(SlaveShell& shell, const proto::SlaveConfig& config, RecordingPlace recordings = {});

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

  /// Before the loop begins: from its first tick on, as a replay needs it. Throws RecordingError.
  void record_from_start(const std::string& file, double max_mb);

  /// Who has the robot: the address that its session was opened from; empty: nobody.
  [[nodiscard]] std::string lease() const;

  /// The newest picture of the loop; callable from any thread but the loop's.
  SlaveSnapshot snapshot();

 private:
  Refusal occupied(const std::string& caller);
  void set_lease(const std::string& holder);

  SideRecording<SlaveRecordBuffer>::Request recording_request(double max_mb) const;
  /// Hands a tape to the loop; false: it did not answer.
  bool attach(SlaveRecordBuffer* record_buffer);

  SlaveShell& shell_;
  SideConfig<proto::SlaveConfig> config_;
  std::uint32_t config_number_ = 0;  // of those that the loop was handed
  RecordingPlace recordings_;
  SideRecording<SlaveRecordBuffer> recording_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::mutex reading_;  // among those who read snapshots
  mutable std::mutex leasing_;
  std::string lease_;
  std::string refused_;  // who was refused last
};

}  // namespace longreach
