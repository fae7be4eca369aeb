#pragma once
// Master and slave on loopback with free ports, as a client sees them through their RPC services.

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

/// The RPC service of one side, through a client.
class StationSide {
 public:
  /// Connects as a client of the site of the tests.
  StationSide(RpcRole role, int port);

  std::optional<proto::Status> status();
  /// Returns an empty text on success, else the server's message.
  std::string engage();
  std::string stop();
  std::string set(const std::string& path, const std::string& value);
  /// Sets all of them or none.
  std::string set(const std::vector<std::pair<std::string, std::string>>& assignments);
  /// Returns the effective configuration or a part of it.
  std::string get(const std::string& path);
  std::string set_delay(double delay_s);

  std::string state();
  /// By name; 0 if there is none.
  std::uint64_t counter(const std::string& name);

 private:
  std::unique_ptr<proto::Control::Stub> stub_;
};

class Station : public ::testing::Test {
 protected:
  void start_slave(const std::vector<std::string>& more = {}, const Streams& streams = {});
  void start_master(const std::vector<std::string>& more = {}, const Streams& streams = {});
  [[nodiscard]] std::string link_address() const { return "127.0.0.1:" + std::to_string(ports_.link); }

  /// Polls until `holds` returns true; returns false after the timeout. The elapsed time is not checked.
  static bool eventually(const std::function<bool()>& holds,
                         std::chrono::seconds timeout = std::chrono::seconds(60));
  bool both_engaged(std::chrono::seconds timeout = std::chrono::seconds(60));
  /// Requests an engagement as soon as it is not refused, and repeats the request if it fails.
  bool engaged();
  /// Waits for a text in the output of a program; its log may be later than its RPC service.
  static bool says(const RunningProgram& program, const std::string& words);
  /// Output of both programs, for messages of failing tests.
  std::string outputs() const;

  Ports ports_ = free_ports();
  std::unique_ptr<RunningProgram> slave_program_;
  std::unique_ptr<RunningProgram> master_program_;
  StationSide slave_{RpcRole::kSlave, ports_.slave_rpc};
  StationSide master_{RpcRole::kMaster, ports_.master_rpc};
};

}  // namespace longreach
