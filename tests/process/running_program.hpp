#pragma once
// A program under test: started with fork and exec; its output is stored. The destructor ends it, and it also
// ends if the test program is killed.

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace longreach {

/// Descriptors for the program; -1: no input, and stored output.
struct Streams {
  static constexpr int kClosed = -2;  // of `in`: as with `<&-`
  int in = -1, out = -1, err = -1;
};

class RunningProgram {
 public:
  /// `name`: one of the programs in the build's bin folder, or an absolute path. The caller owns `streams`.
  RunningProgram(const std::string& name, const std::vector<std::string>& arguments,
                 const Streams& streams = {});
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  [[nodiscard]] pid_t pid() const { return pid_; }
  void signal(int number) const;
  /// Exit status, or 128 + signal; none if it still runs after `timeout`.
  std::optional<int> wait(std::chrono::milliseconds timeout);
  [[nodiscard]] bool running();
  /// Standard output and standard error so far.
  [[nodiscard]] std::string output() const;

 private:
  pid_t pid_ = -1;
  std::optional<int> status_{};
  std::filesystem::path file_;
};

/// Ports that are free at present.
struct Ports {
  int link = 0;
  int slave_rpc = 0;
  int master_rpc = 0;
};
Ports free_ports();

}  // namespace longreach
