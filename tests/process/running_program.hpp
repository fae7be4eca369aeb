#pragma once
// A program under test, started with fork and exec, whose output is captured. The program ends when this
// object is destroyed or the test program is killed.

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace longreach {

/// File descriptors for the program. -1 means no input (`in`) or captured output.
struct Streams {
  static constexpr int kClosed = -2;  // for `in`: the descriptor is closed, as with `<&-` in a shell
  int in = -1, out = -1, err = -1;
};

class RunningProgram {
 public:
  /// Starts a program. `name` is one of the programs in the build's bin folder, or an absolute path. The
  /// caller owns the descriptors in `streams`.
  RunningProgram(const std::string& name, const std::vector<std::string>& arguments,
                 const Streams& streams = {});
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  [[nodiscard]] pid_t pid() const { return pid_; }
  void signal(int number) const;
  /// Returns the exit status or 128 + signal, or std::nullopt if the program is still running after
  /// `timeout`.
  std::optional<int> wait(std::chrono::milliseconds timeout);
  [[nodiscard]] bool running();
  /// Returns the standard output and standard error received so far.
  [[nodiscard]] std::string output() const;

 private:
  pid_t pid_ = -1;
  std::optional<int> status_{};
  std::filesystem::path file_;
};

/// Ports that were free when free_ports() was called.
struct Ports {
  int link = 0;
  int slave_rpc = 0;
  int master_rpc = 0;
};
Ports free_ports();

}  // namespace longreach
