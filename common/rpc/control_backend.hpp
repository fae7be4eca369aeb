#pragma once
// Interface between the RPC service and a side, with one implementation per side. It is called from RPC
// threads. stop() and the queries (status, config, start_config, link) may be called at any time and return
// quickly; the other operations are called one at a time. An operation that changes something is either
// carried out completely and returns none, or changes nothing and returns the reason for the refusal.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "common/config/origins.hpp"
#include "proto/config.pb.h"
#include "proto/control.pb.h"

namespace longreach {

struct Refusal {
  enum class Kind {
    kInvalid,
    kPrecondition,
    kUnavailable
  };  // invalid value; impossible in this state or on this side; no response in time
  Kind kind = Kind::kInvalid;
  std::string message;   // one sentence that states the field, the reason and a remedy
  std::string holder{};  // address of the master that has control of the robot, if this is the reason
};

using Assignments = std::vector<std::pair<std::string, std::string>>;  // path of the field, and value as text

/// The sentence `done`, unless it was refused.
inline std::variant<std::string, Refusal> unless(std::optional<Refusal> refusal, std::string done) {
  if (refusal) return *std::move(refusal);
  return done;
}

class ControlBackend {
 public:
  virtual ~ControlBackend() = default;

  virtual proto::Status status() = 0;
  /// Returns the effective configuration (MasterConfig or SlaveConfig).
  virtual std::shared_ptr<const google::protobuf::Message> config() = 0;
  /// Returns the configuration with which the side started, whose limits are upper bounds.
  virtual std::shared_ptr<const google::protobuf::Message> start_config() = 0;
  /// Returns where the values of start_config() come from.
  virtual const Origins& start_origins() = 0;
  virtual std::optional<Refusal> set_config(const Assignments& assignments) = 0;
  virtual proto::Impairment link() = 0;
  /// Replaces the impairment of the data that this side receives. `impairment` is complete and valid.
  virtual std::optional<Refusal> set_link(const proto::Impairment& impairment) = 0;
  /// Carries out every other action of the schema; returns the sentence for the client.
  virtual std::variant<std::string, Refusal> run(const proto::Action& action) = 0;
  virtual std::optional<Refusal> stop() = 0;
  /// `caller` is the address of the requesting master.
  virtual std::variant<proto::OpenSessionResponse, Refusal> open_session(
      const proto::OpenSessionRequest& request, const std::string& caller) = 0;
  virtual std::optional<Refusal> close_session(std::uint64_t session) = 0;
};

}  // namespace longreach
