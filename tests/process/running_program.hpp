#pragma once
// A real program under test: started with fork and exec, its output kept, ended with the object however the
// test ends, and with the test program should that be killed.

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace longreach {

/// Descriptors that a program gets; -1: nothing to read, and output that is kept.
struct Streams {
  static constexpr int kClosed = -2;  // of `in`: as by `<&-`
  int in = -1, out = -1, err = -1;
};

class RunningProgram {
 public:
  /// `name`: of one of the programs in the build's bin folder, or an absolute path. `streams` stay the
  /// caller's.
  RunningProgram(const std::string& name, const std::vector<std::string>& arguments,
                 const Streams& streams = {});
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  [[nodiscard]] pid_t pid() const { return pid_; }
  void signal(int number) const;
  /// Exit status, or 128 + signal; none when it still runs after `timeout`.
  std::optional<int> wait(std::chrono::milliseconds timeout);
  [[nodiscard]] bool running();
  /// Standard output and standard error, as written so far.
  [[nodiscard]] std::string output() const;

 private:
  pid_t pid_ = -1;
  std::optional<int> status_{};
  std::filesystem::path file_;
};

/// Ports that nobody uses just now.
struct Ports {
  int link = 0;
  int slave_rpc = 0;
  int master_rpc = 0;
};
Ports free_ports();

}  // namespace longreach
