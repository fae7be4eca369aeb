#pragma once
// What a side lets the RPC service do. One implementation a side; called from RPC threads: stop() and what
// only looks (status, config, start_config, link) at any time and soon, whatever else is under way; the rest
// one call at a time. A call that changes something returns nothing when it was carried out as a whole, or
// why it was refused; then nothing has changed.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "proto/config.pb.h"
#include "proto/control.pb.h"

namespace longreach {

struct Refusal {
  enum class Kind {
    kInvalid,
    kPrecondition,
    kUnavailable
  };  // bad value; not now or not here; no answer in time
  Kind kind = Kind::kInvalid;
  std::string message;   // one sentence: which field, why, what to do
  std::string holder{};  // address of the master that has the robot, where that is why
};

using Assignments = std::vector<std::pair<std::string, std::string>>;  // field path, value as text

class ControlBackend {
 public:
  virtual ~ControlBackend() = default;

  virtual proto::Status status() = 0;
  /// The effective configuration (MasterConfig or SlaveConfig).
  virtual std::shared_ptr<const google::protobuf::Message> config() = 0;
  /// What the side was started with: the ceiling of its limits.
  virtual std::shared_ptr<const google::protobuf::Message> start_config() = 0;
  virtual std::optional<Refusal> set_config(const Assignments& assignments) = 0;
  virtual proto::Impairment link() = 0;
  /// The complete, validated impairment of what this side receives.
  virtual std::optional<Refusal> set_link(const proto::Impairment& impairment) = 0;
  virtual std::optional<Refusal> set_mode(proto::Mapping::Mode mode) = 0;
  virtual std::optional<Refusal> set_scale(double scale) = 0;
  virtual std::optional<Refusal> engage() = 0;
  virtual std::optional<Refusal> stop() = 0;
  /// `caller`: address of the master that asks.
  virtual std::variant<proto::OpenSessionResponse, Refusal> open_session(
      const proto::OpenSessionRequest& request, const std::string& caller) = 0;
  virtual std::optional<Refusal> close_session(std::uint64_t session) = 0;
  /// Return the file, with how much is in it at the end.
  virtual std::variant<std::string, Refusal> start_recording(const std::string& name, double max_mb) = 0;
  virtual std::variant<std::string, Refusal> stop_recording() = 0;
};

}  // namespace longreach
