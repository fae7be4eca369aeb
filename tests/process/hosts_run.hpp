#pragma once
// Runs deploy/hosts with the programs of this build: slave and master in two network namespaces. If creating
// namespaces is not permitted, the script exits with an error and the test fails.

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "tests/process/running_program.hpp"

namespace longreach {

class HostsRun {
 public:
  explicit HostsRun(const std::vector<std::string>& options);

  /// Waits until the hosts are up. Returns false if they failed to start; output() then contains the reason.
  bool up();
  /// Waits until the output of the master, which prints one line per second, contains the text at least
  /// `times` times.
  bool shows(const std::string& text, std::chrono::seconds timeout, int times = 1);
  /// Starts the client on the master's host, with its default timeout.
  [[nodiscard]] std::unique_ptr<RunningProgram> client(const std::vector<std::string>& command) const;
  /// Process ID of the process that keeps one of the network namespaces open.
  [[nodiscard]] int holder() const;

  RunningProgram& script() { return script_; }
  [[nodiscard]] std::string output() const { return script_.output(); }
  /// Log of the slave and the link.
  [[nodiscard]] std::string log() const;
  [[nodiscard]] std::string all() const { return output() + log(); }

 private:
  std::filesystem::path log_;
  RunningProgram script_;
};

}  // namespace longreach
