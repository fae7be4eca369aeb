#pragma once
// deploy/hosts with the programs of this build: slave and master in two network namespaces, and what the
// master's user sees of them. Without the right to make namespaces the script refuses, and so the test fails
// with its sentence.

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "tests/process/running_program.hpp"

namespace longreach {

class HostsRun {
 public:
  explicit HostsRun(const std::vector<std::string>& options);

  /// Waits until the hosts are up. False: they did not come up; output() says why.
  bool up();
  /// Waits until the master's output, a line a second, contains this so many times.
  bool shows(const std::string& text, std::chrono::seconds timeout, int times = 1);
  /// The client on the master's host; waits for an answer for two minutes.
  [[nodiscard]] std::unique_ptr<RunningProgram> client(const std::vector<std::string>& command) const;
  /// One of the processes that holds the network namespaces.
  [[nodiscard]] int holder() const;

  RunningProgram& script() { return script_; }
  [[nodiscard]] std::string output() const { return script_.output(); }
  /// Of the slave and of the link.
  [[nodiscard]] std::string log() const;
  [[nodiscard]] std::string all() const { return output() + log(); }

 private:
  std::filesystem::path log_;
  RunningProgram script_;
};

}  // namespace longreach
