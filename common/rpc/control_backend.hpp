#pragma once
// Operations of a side for the RPC service, with one implementation per side, called from RPC threads. stop()
// and the queries (status, config, start_config, link) may be called at any time and return quickly; the
// other operations are called one at a time. An operation that changes something returns nothing if it was
// carried out completely, or the reason for its refusal; then nothing has changed.

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
  };  // invalid value; not possible in this state or at this side; no response in time
  Kind kind = Kind::kInvalid;
  std::string message;   // one sentence: field, reason, remedy
  std::string holder{};  // address of the master that has control of the robot, if this is the reason
};

using Assignments = std::vector<std::pair<std::string, std::string>>;  // field path, value as text

class ControlBackend {
 public:
  virtual ~ControlBackend() = default;

  virtual proto::Status status() = 0;
  /// The effective configuration (MasterConfig or SlaveConfig).
  virtual std::shared_ptr<const google::protobuf::Message> config() = 0;
  /// The configuration at the start of the side: the bounds of its limits.
  virtual std::shared_ptr<const google::protobuf::Message> start_config() = 0;
  virtual std::optional<Refusal> set_config(const Assignments& assignments) = 0;
  virtual proto::Impairment link() = 0;
  /// Sets the complete, validated impairment of the data that this side receives.
  virtual std::optional<Refusal> set_link(const proto::Impairment& impairment) = 0;
  virtual std::optional<Refusal> set_mode(proto::Mapping::Mode mode) = 0;
  virtual std::optional<Refusal> set_scale(double scale) = 0;
  virtual std::optional<Refusal> engage() = 0;
  virtual std::optional<Refusal> stop() = 0;
  /// `caller`: address of the requesting master.
  virtual std::variant<proto::OpenSessionResponse, Refusal> open_session(
      const proto::OpenSessionRequest& request, const std::string& caller) = 0;
  virtual std::optional<Refusal> close_session(std::uint64_t session) = 0;
  /// Return the file and the amount of recorded data at the end.
  virtual std::variant<std::string, Refusal> start_recording(const std::string& name, double max_mb) = 0;
  virtual std::variant<std::string, Refusal> stop_recording() = 0;
};

}  // namespace longreach
