#pragma once
// Runs deploy/hosts with the programs of this build: slave and master in two network namespaces, and the
// output of the master. Without the right to create namespaces the script refuses, and the test fails with
// its message.

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "tests/process/running_program.hpp"

namespace longreach {

class HostsRun {
 public:
  explicit HostsRun(const std::vector<std::string>& options);

  /// Waits until the hosts are up. False: they failed to start; output() gives the reason.
  bool up();
  /// Waits until the master's output, one line per second, contains the text `times` times.
  bool shows(const std::string& text, std::chrono::seconds timeout, int times = 1);
  /// Runs the client on the master's host, with a timeout of two minutes.
  [[nodiscard]] std::unique_ptr<RunningProgram> client(const std::vector<std::string>& command) const;
  /// Process that holds one of the network namespaces.
  [[nodiscard]] int holder() const;

  RunningProgram& script() { return script_; }
  [[nodiscard]] std::string output() const { return script_.output(); }
  /// Log of the slave and of the link.
  [[nodiscard]] std::string log() const;
  [[nodiscard]] std::string all() const { return output() + log(); }

 private:
  std::filesystem::path log_;
  RunningProgram script_;
};

}  // namespace longreach
