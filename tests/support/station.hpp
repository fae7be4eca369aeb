#pragma once
// Master and slave on loopback with free ports, seen through their RPC service, as a client sees them.

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

/// One side's RPC service, through a client of its own.
class StationSide {
 public:
  /// Comes as a client of the test's site.
  StationSide(RpcRole role, int port);

  std::optional<proto::Status> status();
  /// Empty when it was carried out, else the server's sentence.
  std::string engage();
  std::string stop();
  std::string set(const std::string& path, const std::string& value);
  /// All of them or none.
  std::string set(const std::vector<std::pair<std::string, std::string>>& assignments);
  /// The effective configuration or a part of it.
  std::string get(const std::string& path);
  std::string set_delay(double delay_s);

  std::string state();
  /// By name; 0 when there is none.
  std::uint64_t counter(const std::string& name);

 private:
  std::unique_ptr<proto::Control::Stub> stub_;
};

class Station : public ::testing::Test {
 protected:
  void start_slave(const std::vector<std::string>& more = {}, const Streams& streams = {});
  void start_master(const std::vector<std::string>& more = {}, const Streams& streams = {});
  [[nodiscard]] std::string link_address() const { return "127.0.0.1:" + std::to_string(ports_.link); }

  /// Asks until it holds; false when it did not within the time. Polls, and asserts nothing about how long it
  /// took.
  static bool eventually(const std::function<bool()>& holds,
                         std::chrono::seconds timeout = std::chrono::seconds(60));
  bool both_engaged(std::chrono::seconds timeout = std::chrono::seconds(60));
  /// Engages as soon as that is not refused, and again when it comes to nothing.
  bool engaged();
  /// Waits for words in what a program prints; its log may come later than what its RPC service tells.
  static bool says(const RunningProgram& program, const std::string& words);
  /// What both programs printed, for messages of failing tests.
  std::string outputs() const;

  Ports ports_ = free_ports();
  std::unique_ptr<RunningProgram> slave_program_;
  std::unique_ptr<RunningProgram> master_program_;
  StationSide slave_{RpcRole::kSlave, ports_.slave_rpc};
  StationSide master_{RpcRole::kMaster, ports_.master_rpc};
};

}  // namespace longreach
