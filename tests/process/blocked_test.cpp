// Whoever does not read what the programs write, a terminal or a pipe, stops nothing: neither the hand nor
// RPC nor the end of a program.
#include <fcntl.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "tests/process/load.hpp"
#include "tests/process/terminal.hpp"
#include "tests/support/station.hpp"

namespace longreach::blocked_test {
namespace {

using std::chrono::seconds;

/// A pipe that is full, whose reader never reads.
struct FullPipe {
  std::array<int, 2> ends{};
  FullPipe() {
    EXPECT_EQ(::pipe2(ends.data(), O_NONBLOCK | O_CLOEXEC), 0);
    const std::array<char, 4096> bytes{};
    while (::write(ends[1], bytes.data(), bytes.size()) > 0) {
    }
    EXPECT_EQ(::fcntl(ends[1], F_SETFL, 0), 0);  // a write waits
  }
  ~FullPipe() {
    ::close(ends[0]);
    ::close(ends[1]);
  }
  FullPipe(const FullPipe&) = delete;
  FullPipe& operator=(const FullPipe&) = delete;
};

/// One thread of a program, stopped while this lives.
class FrozenThread {
 public:
  FrozenThread(pid_t program, const std::string& name) {
    for (const auto& task :
         std::filesystem::directory_iterator("/proc/" + std::to_string(program) + "/task")) {
      std::string own;
      std::ifstream(task.path() / "comm") >> own;
      if (own == name) thread_ = std::stoi(task.path().filename());
    }
    EXPECT_GT(thread_, 0) << "no thread " << name;
    EXPECT_EQ(::ptrace(PTRACE_ATTACH, thread_, nullptr, nullptr), 0);
    EXPECT_EQ(::waitpid(thread_, nullptr, __WALL), thread_);
  }
  ~FrozenThread() { ::ptrace(PTRACE_DETACH, thread_, nullptr, nullptr); }
  FrozenThread(const FrozenThread&) = delete;
  FrozenThread& operator=(const FrozenThread&) = delete;

 private:
  pid_t thread_ = -1;
};

class Blocked : public Station {
 protected:
  static constexpr auto kSoon = seconds(20);

  std::vector<std::string> keyboard(const std::string& view) const {
    return {"--operator", "keyboard", "--mode", "rate", "--engage", "--core-dumps", "--view", view};
  }
  double tool_x_m() {
    const auto now = slave_.status();
    return now ? now->tool_m(0) : 0.0;
  }
  bool tool_moves() {
    const double before = tool_x_m();
    return eventually([&] { return std::abs(tool_x_m() - before) > 0.002; }, kSoon);
  }
  bool tool_rests() {
    double last = tool_x_m();
    int still = 0;
    return eventually(
        [&] {
          const double now = tool_x_m();
          still = std::abs(now - last) < 1e-5 ? still + 1 : 0;
          last = now;
          return still > 10;
        },
        kSoon);
  }
  bool comes_to(StationSide& side, const std::string& state) {
    return eventually([&] { return side.state() == state; }, kSoon);
  }
};

TEST_F(Blocked, ATerminalThatNobodyReadsLeavesTheKeysAsTheyAre) {
  const Terminal terminal;
  start_slave({"--set", "scene_file=scenes/free.txtpb"});
  start_master(keyboard("auto"), {terminal.inner, terminal.inner, -1});
  ASSERT_TRUE(eventually([&] { return terminal.full(); })) << outputs();
  ASSERT_TRUE(both_engaged()) << outputs();
  terminal.type("WWWW");
  {
    const HeldKey held(terminal.outer);
    ASSERT_TRUE(tool_moves()) << outputs();
  }
  terminal.type("x");
  EXPECT_TRUE(comes_to(master_, "Stopped")) << outputs();
  EXPECT_TRUE(comes_to(slave_, "Stopped")) << outputs();
  EXPECT_TRUE(tool_rests());
  terminal.type("q");
  EXPECT_EQ(master_program_->wait(kSoon), 0) << outputs();
  termios mode{};
  EXPECT_EQ(::tcgetattr(terminal.inner, &mode), 0);
  EXPECT_NE(mode.c_lflag & ICANON, 0u);
  EXPECT_EQ(::fcntl(terminal.inner, F_GETFL) & O_NONBLOCK, 0);
}

TEST_F(Blocked, UnpolledHandCausesHold) {
  const Terminal terminal;
  start_slave({"--set", "scene_file=scenes/free.txtpb"});
  start_master(keyboard("none"), {terminal.inner, -1, -1});
  ASSERT_TRUE(both_engaged()) << outputs();
  const HeldKey held(terminal.outer);
  terminal.type("WWWW");
  ASSERT_TRUE(tool_moves()) << outputs();
  {
    const FrozenThread hand(master_program_->pid(), "hand");
    ASSERT_TRUE(comes_to(slave_, "Holding")) << outputs();
    EXPECT_EQ(master_.status()->cause(), "hand stale");
    EXPECT_TRUE(tool_rests());
    EXPECT_TRUE(says(*master_program_, "to=Holding cause=\"hand stale\"")) << outputs();
  }
  std::this_thread::sleep_for(seconds(1));
  EXPECT_EQ(slave_.state(), "Holding");
  EXPECT_TRUE(engaged()) << outputs();
}

TEST_F(Blocked, AFullStandardErrorDelaysNoCallNoTickAndNoEnd) {
  const FullPipe pipe;
  start_slave({}, {-1, pipe.ends[1], pipe.ends[1]});
  start_master({"--operator", "none", "--view", "plain"}, {-1, pipe.ends[1], pipe.ends[1]});
  ASSERT_TRUE(engaged());
  Disturbance disturbance(slave_, master_);
  const std::uint64_t refused = slave_.counter("rpc_refused");
  {
    const IdleConnections unknown_peers(ports_.slave_rpc, 1);
    ASSERT_EQ(unknown_peers.connected(), 1);
    ASSERT_EQ(::send(unknown_peers.socket(0), "no TLS at all\n", 14, 0), 14);
    ASSERT_TRUE(eventually([&] { return slave_.counter("rpc_refused") > refused; }, kSoon));
  }
  EXPECT_EQ(slave_.state(), "Engaged");
  disturbance.expect_none("a full standard error");
  EXPECT_EQ(master_.stop(), "");
  EXPECT_TRUE(comes_to(slave_, "Stopped"));
  for (RunningProgram* program : {master_program_.get(), slave_program_.get()}) {
    program->signal(SIGTERM);
    EXPECT_EQ(program->wait(kSoon), 0);
  }
}

}  // namespace
}  // namespace longreach::blocked_test
