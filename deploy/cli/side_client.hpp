#pragma once
// RPC client of one side. Every call ends after the timeout at the latest, including the connection.

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "deploy/cli/invocation.hpp"
#include "proto/config.pb.h"
#include "proto/control.pb.h"

namespace grpc {
class Channel;
class ClientContext;
class Status;
}  // namespace grpc

namespace longreach {

/// A call that was not carried out: one sentence that names the side.
class SideError : public std::runtime_error {
 public:
  enum class Kind {
    kDown,      // no answer: the request may or may not have been carried out
    kRefused,   // not in this state, or not by this side: nothing has changed
    kBadValue,  // invalid: nothing has changed
  };
  SideError(Kind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  [[nodiscard]] Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

/// For calls that SideClient does not have.
std::shared_ptr<grpc::Channel> connect(Side side, const Options& options);
SideError failure(Side side, const Options& options, const grpc::ClientContext& context,
                  const grpc::Status& status);

class SideClient {
 public:
  SideClient(Side side, const Options& options);
  SideClient(SideClient&&) noexcept;
  ~SideClient();

  // All throw SideError. Functions that return a text return the answer of the side.
  proto::Status status();  // also if another side answers at the address
  std::string get(const std::string& path);
  std::string set(const std::vector<std::pair<std::string, std::string>>& assignments);
  proto::Impairment link();
  std::string set_link(const proto::Impairment& impairment, bool replace);
  std::string set_mode(proto::Mapping::Mode mode);
  std::string set_scale(double scale);
  std::string engage();
  std::string stop();
  std::string start_recording(const std::string& name, double max_mb);
  std::string stop_recording();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Information about a side: its status, or why there is none.
struct SideReport {
  Side side = Side::kMaster;
  std::string address;
  std::optional<proto::Status> status{};
  std::string error;  // one sentence, if there is no status
};

/// The newest status of a side, read by a separate thread, which reconnects when the side is available again.
class StatusStream {
 public:
  StatusStream(Side side, const Options& options, double rate_hz);
  ~StatusStream();
  StatusStream(const StatusStream&) = delete;
  StatusStream& operator=(const StatusStream&) = delete;

  [[nodiscard]] SideReport newest() const;
  /// Returns when there is a status or a reason why there is none: within the timeout.
  void wait_for_first() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
