#pragma once
// What both sides do alike for RPC clients: configuration, impairment of the link, recordings and stop. Their configuration is
// the initial one, and the current one, which is replaced as a whole, so that readers do not wait while a change is
// prepared.

#include <google/protobuf/util/message_differencer.h>

#include <chrono>
#include <mutex>

#include "common/config/config.hpp"
#include "common/recording/side_recording.hpp"
#include "common/rpc/config_change.hpp"
#include "common/rpc/recording_answers.hpp"
#include "common/rpc/side_shell.hpp"
#include "common/rpc/status_fields.hpp"

namespace longreach {

template <class Shell_>
class SideService : public ControlBackend {
 public:
  using Shell = Shell_;
  using Message = typename Shell::Parts::Message;
  using Snapshot = typename Shell::Snapshot;

  /// `config` is the loaded configuration with the contents of its files; its limits are upper bounds for later changes.
  SideService(Shell& shell, const Message& config, RecordingPlace recordings = {}, Origins origins = {})
      : shell_(shell),
        start_(std::make_shared<const Message>(config)),
        present_(start_),
        origins_(std::move(origins)),
        recordings_(std::move(recordings)) {}

  std::shared_ptr<const google::protobuf::Message> config() final { return present(); }
  std::shared_ptr<const google::protobuf::Message> start_config() final { return start_; }
  const Origins& start_origins() final { return origins_; }
  std::optional<Refusal> set_config(const Assignments& assignments) final;
  proto::Impairment link() final { return present()->link().impairment(); }
  std::optional<Refusal> set_link(const proto::Impairment& impairment) final;
  std::variant<std::string, Refusal> run(const proto::Action& action) final;
  std::optional<Refusal> stop() final;

  /// Starts a recording. Call this before the loop starts, because a replay requires that the first tick is recorded.
  /// Throws RecordingError.
  void record_from_start(const std::string& file, double max_mb) {
    start_recording(file, max_mb, [this](RecordBuffer* record_buffer) {
      shell_.record(record_buffer);
      return true;
    });
  }

  /// Returns the newest snapshot of the loop. May be called from any thread except that of the loop.
  Snapshot snapshot() {
    const std::lock_guard lock(reading_);
    return shell_.snapshots().read();
  }

 protected:
  using Change = typename Shell::Parts::Change;

  /// Adds to a change what only this side has, or returns why it is refused.
  virtual std::optional<Refusal> check(const Assignments& assignments, Change& change) = 0;
  /// Carries out every action but those of recordings.
  virtual std::variant<std::string, Refusal> act(const proto::Action& action) = 0;

  /// Returns what the status of both sides contains.
  proto::Status common_status(const Snapshot& s);
  /// Passes a command to the loop. Returns none if the loop carried it out. A refusal names the fields `not_while_engaged`.
  std::optional<Refusal> post(typename Shell::Command command, const std::string& not_while_engaged = {});
  [[nodiscard]] std::shared_ptr<const Message> present() const {
    const std::lock_guard lock(configuring_);
    return present_;
  }
  void add_event(const std::string& text) { recording_.add_event(text); }

 private:
  using RecordBuffer = typename Shell::RecordBuffer;

  /// attach(buffer) passes the record buffer to the loop. Throws RecordingError.
  template <class Attach>
  void start_recording(const std::filesystem::path& file, double max_mb, const Attach& attach);
  void put(Message config) {
    auto next = std::make_shared<const Message>(std::move(config));
    const std::lock_guard lock(configuring_);
    present_.swap(next);
  }

  Shell& shell_;
  const std::shared_ptr<const Message> start_;
  mutable std::mutex configuring_;  // protects the next pointer
  std::shared_ptr<const Message> present_;
  const Origins origins_;
  std::uint32_t config_number_ = 0;  // number of the last configuration passed to the loop
  RecordingPlace recordings_;
  SideRecording<RecordBuffer> recording_{Shell::Parts::kSide, log_end};
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::mutex reading_;  // serialises readers of snapshots
};

template <class Shell>
proto::Status SideService<Shell>::common_status(const Snapshot& s) {
  proto::Status out;
  out.set_side(Shell::Parts::kSide);
  out.set_version(std::string(build_version()));
  out.set_uptime_s(std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count());
  *out.mutable_impairment() = link();
  out.set_state(std::string(to_string(s.view.state)));
  out.set_cause(std::string(to_string(s.view.cause)));
  out.set_engagement(s.view.engagement);
  out.set_in_contact(s.view.in_contact);
  if (s.view.approach_m_per_s > 0.0) out.set_approach_m_per_s(s.view.approach_m_per_s);
  fill(out, s.side);
  fill(out, recording_.status());
  return out;
}

template <class Shell>
std::optional<Refusal> SideService<Shell>::post(typename Shell::Command command,
                                                const std::string& not_while_engaged) {
  const auto answer = shell_.mailbox().post(std::move(command), std::chrono::milliseconds(1000));
  if (!answer)
    return Refusal{Refusal::Kind::kUnavailable,
                   "the control loop did not respond within 1 s, so nothing was changed; try again"};
  if (*answer == LoopAnswer::kDone) return std::nullopt;
  if (*answer == LoopAnswer::kOccupied)
    return Refusal{Refusal::Kind::kPrecondition, "another master has control of the robot"};
  return Refusal{Refusal::Kind::kPrecondition,
                 not_while_engaged + " cannot be changed while the robot is engaged; stop the robot first"};
}

template <class Shell>
std::optional<Refusal> SideService<Shell>::set_config(const Assignments& assignments) {
  const auto before = present();
  auto planned = plan_change({*start_, *before}, assignments);
  if (const auto* refusal = std::get_if<Refusal>(&planned)) return *refusal;
  const auto& plan = std::get<ConfigChange>(planned);
  const auto& after = static_cast<const Message&>(*plan.after);
  Change change;
  change.config = to_struct(after);
  change.only_disengaged = !plan.not_while_engaged.empty();
  change.impairment = !google::protobuf::util::MessageDifferencer::Equals(after.link().impairment(),
                                                                          before->link().impairment());
  if (auto refusal = check(assignments, change)) return refusal;
  change.number = ++config_number_;
  recording_.add_config(config_number_, recorded_text(after));
  auto refusal = post(std::move(change), plan.not_while_engaged);
  if (!refusal) put(after);
  return refusal;
}

template <class Shell>
std::optional<Refusal> SideService<Shell>::set_link(const proto::Impairment& impairment) {
  auto refusal = post(to_struct(impairment));
  if (refusal) return refusal;
  Message after = *present();
  *after.mutable_link()->mutable_impairment() = impairment;
  put(std::move(after));
  add_event("link impaired: " + impairment.ShortDebugString());
  return std::nullopt;
}

template <class Shell>
std::variant<std::string, Refusal> SideService<Shell>::run(const proto::Action& action) {
  const auto attach = [this](RecordBuffer* record_buffer) {
    return !post(RecordingChange<RecordBuffer>{record_buffer});
  };
  try {
    if (action.has_stop_recording()) return in_words(recording_.stop(attach));
    if (!action.has_start_recording()) return act(action);
    const auto& asked = action.start_recording();
    const std::filesystem::path folder =
        recordings_.folder.empty() ? default_recordings() : std::filesystem::path(recordings_.folder);
    start_recording(recording_path(folder, asked.name(), Shell::Parts::kSide), asked.max_mb(), attach);
    return recording_.status().file;
  } catch (const RecordingError& e) {
    return Refusal{Refusal::Kind::kPrecondition, e.what()};
  }
}

template <class Shell>
std::optional<Refusal> SideService<Shell>::stop() {
  if (shell_.stops().ask(std::chrono::milliseconds(1000))) return std::nullopt;
  return Refusal{Refusal::Kind::kUnavailable,
                 "the control loop did not respond within 1 s; the robot stops as soon as the loop resumes"};
}

template <class Shell>
template <class Attach>
void SideService<Shell>::start_recording(const std::filesystem::path& file, double max_mb,
                                         const Attach& attach) {
  recording_.start({.file = file,
                    .max_mb = max_mb,
                    .rate_hz = present()->loop().rate_hz(),
                    .seed = recordings_.seed,
                    .config_number = config_number_,
                    .config_text = recorded_text(*present())},
                   attach);
  log_start(recording_.status());
}

}  // namespace longreach
