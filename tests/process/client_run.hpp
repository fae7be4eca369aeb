#pragma once
// Runs the client against sides that the test simulates, and captures standard output and standard error
// separately.

#include <sys/types.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/rpc/rpc_server.hpp"
#include "tests/support/test_site.hpp"
#include "tests/unit/common/rpc/control_fake_backend.hpp"

namespace longreach {

class ClientRun {
 public:
  /// If `terminal` is true, standard output is a terminal.
  explicit ClientRun(const std::vector<std::string>& arguments, bool terminal = false);
  ~ClientRun();
  ClientRun(const ClientRun&) = delete;
  ClientRun& operator=(const ClientRun&) = delete;

  void signal(int number) const;
  /// Reads the output for at most 30 s, until the client ends or, if `until` is not empty, has written
  /// `until` to standard output.
  void read(const std::string& until = "");
  /// Returns the exit status, 128 + signal, or -1 if the client did not end. Call this after read().
  int status();
  [[nodiscard]] const std::string& out() const { return out_; }
  [[nodiscard]] const std::string& err() const { return err_; }

 private:
  pid_t pid_ = -1;
  int out_end_ = -1;
  int err_end_ = -1;
  std::string out_;
  std::string err_;
  std::optional<int> status_{};
};

/// A simulated master and slave, and the client options for connecting to them.
struct FakeStation {
  FakeBackend master{"master"};
  FakeBackend slave{"slave"};
  std::unique_ptr<RpcServer> master_server =
      std::make_unique<RpcServer>("127.0.0.1:0", master, "master", test_site(RpcRole::kMaster));
  std::unique_ptr<RpcServer> slave_server =
      std::make_unique<RpcServer>("127.0.0.1:0", slave, "slave", test_site(RpcRole::kSlave));
  std::string master_address = master_server->address();
  std::string slave_address = slave_server->address();

  [[nodiscard]] std::vector<std::string> arguments(const std::vector<std::string>& command) const {
    std::vector<std::string> words{"--master", master_address, "--slave", slave_address};
    words.insert(words.end(), command.begin(), command.end());
    return words;
  }
};

}  // namespace longreach
