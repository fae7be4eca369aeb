#include "tests/process/client_run.hpp"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>

namespace longreach {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kTimeout = std::chrono::seconds(30);

/// The two ends of a stream: what the client writes to, and what the test reads from.
struct Stream {
  int write_end = -1;
  int read_end = -1;
};

Stream open_stream(bool terminal) {
  Stream stream;
  std::array<int, 2> ends{};
  if (terminal) {
    if (::openpty(&stream.read_end, &stream.write_end, nullptr, nullptr, nullptr) != 0)
      throw std::runtime_error("no terminal");
  } else {
    if (::pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
    stream = {ends[1], ends[0]};
  }
  for (const int end : {stream.write_end, stream.read_end}) ::fcntl(end, F_SETFD, FD_CLOEXEC);
  return stream;
}

/// False at the end of the stream.
bool take(int end, std::string& text) {
  std::array<char, 4096> bytes{};
  const ssize_t count = ::read(end, bytes.data(), bytes.size());
  if (count > 0) text.append(bytes.data(), static_cast<std::size_t>(count));
  return count > 0;
}

}  // namespace

ClientRun::ClientRun(const std::vector<std::string>& arguments, bool terminal) {
  std::vector<std::string> words{std::string(LONGREACH_BIN) + "/longreach"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const Stream out = open_stream(terminal);
  const Stream err = open_stream(false);
  ::setenv("LONGREACH_HOME", LONGREACH_DEPLOY, 1);
  // Spawned, not forked: the sides' RPC threads live in this program.
  posix_spawn_file_actions_t actions{};
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, out.write_end, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.write_end, STDERR_FILENO);
  const int failed = ::posix_spawn(&pid_, pointers[0], &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(out.write_end);
  ::close(err.write_end);
  out_end_ = out.read_end;
  err_end_ = err.read_end;
  if (failed != 0) throw std::runtime_error("cannot start the client");
}

ClientRun::~ClientRun() {
  if (!status_) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  ::close(out_end_);
  ::close(err_end_);
}

void ClientRun::signal(int number) const { ::kill(pid_, number); }

void ClientRun::read(const std::string& until) {
  const auto deadline = Clock::now() + kTimeout;
  std::array<pollfd, 2> ends{{{out_end_, POLLIN, 0}, {err_end_, POLLIN, 0}}};
  while (Clock::now() < deadline && (ends[0].fd >= 0 || ends[1].fd >= 0)) {
    if (!until.empty() && out_.find(until) != std::string::npos) return;
    ::poll(ends.data(), ends.size(), 100);
    if (ends[0].revents != 0 && !take(out_end_, out_)) ends[0].fd = -1;
    if (ends[1].revents != 0 && !take(err_end_, err_)) ends[1].fd = -1;
  }
}

int ClientRun::status() {
  const auto deadline = Clock::now() + kTimeout;
  while (!status_ && Clock::now() < deadline) {
    int raw = 0;
    if (::waitpid(pid_, &raw, WNOHANG) == pid_)
      status_ = WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw);
    if (!status_) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return status_.value_or(-1);
}

}  // namespace longreach
