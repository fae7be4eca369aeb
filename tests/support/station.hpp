#pragma once
// Starts a master and a slave on loopback with free ports, and accesses them through their RPC services as a
// client does.

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "proto/control.grpc.pb.h"
#include "tests/process/running_program.hpp"
#include "tests/support/test_site.hpp"

namespace longreach {

/// A client of the RPC service of one side.
class StationSide {
 public:
  /// Connects with the client certificate of the test site.
  StationSide(RpcRole role, int port);

  std::optional<proto::Status> status();
  /// These functions return an empty string on success, and otherwise the server's message.
  std::string engage();
  std::string stop();
  std::string set(const std::string& path, const std::string& value);
  /// Sets all of the fields or none of them.
  std::string set(const std::vector<std::pair<std::string, std::string>>& assignments);
  /// Returns the effective configuration, or the part of it at `path`.
  std::string get(const std::string& path);
  std::string set_delay(double delay_s);

  std::string state();
  /// Returns the value of a counter, or 0 if there is no counter with this name.
  std::uint64_t counter(const std::string& name);

 private:
  std::unique_ptr<proto::Control::Stub> stub_;
};

class Station : public ::testing::Test {
 protected:
  void start_slave(const std::vector<std::string>& more = {}, const Streams& streams = {});
  void start_master(const std::vector<std::string>& more = {}, const Streams& streams = {});
  [[nodiscard]] std::string link_address() const { return "127.0.0.1:" + std::to_string(ports_.link); }

  /// Polls until `holds` returns true. Returns false if the timeout expires.
  static bool eventually(const std::function<bool()>& holds,
                         std::chrono::seconds timeout = std::chrono::seconds(60));
  bool both_engaged(std::chrono::seconds timeout = std::chrono::seconds(60));
  /// Requests an engagement, repeats the request while it is refused or fails, and returns whether both sides
  /// have engaged.
  bool engaged();
  /// Waits until a text appears in the output of a program. Log lines may appear later than the corresponding
  /// RPC status.
  static bool says(const RunningProgram& program, const std::string& words);
  /// Returns the output of both programs, for failure messages.
  std::string outputs() const;

  Ports ports_ = free_ports();
  std::unique_ptr<RunningProgram> slave_program_;
  std::unique_ptr<RunningProgram> master_program_;
  StationSide slave_{RpcRole::kSlave, ports_.slave_rpc};
  StationSide master_{RpcRole::kMaster, ports_.master_rpc};
};

}  // namespace longreach
