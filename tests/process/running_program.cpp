#include "tests/process/running_program.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "tests/support/test_site.hpp"

namespace longreach {
namespace {

/// Between fork and exec: async-signal-safe calls only.
[[noreturn]] void become(char* const* arguments, int output, const Streams& streams) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int null = ::open("/dev/null", O_RDONLY);
  ::dup2(streams.in < 0 ? null : streams.in, STDIN_FILENO);
  ::dup2(streams.out < 0 ? output : streams.out, STDOUT_FILENO);
  ::dup2(streams.err < 0 ? output : streams.err, STDERR_FILENO);
  if (streams.in == Streams::kClosed) ::close(STDIN_FILENO);
  ::execv(arguments[0], arguments);
  _exit(127);
}

}  // namespace

RunningProgram::RunningProgram(const std::string& name, const std::vector<std::string>& arguments,
                               const Streams& streams) {
  static std::atomic<int> count{0};
  file_ = std::filesystem::temp_directory_path() /
          ("longreach-" + std::to_string(getpid()) + "-" + std::to_string(++count) + ".txt");
  std::vector<std::string> words = {(std::filesystem::path(LONGREACH_BIN) / name).string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const int output = ::open(file_.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_APPEND | O_CLOEXEC, 0600);
  ::setenv("LONGREACH_HOME", LONGREACH_DEPLOY, 1);
  (void)test_site(RpcRole::kClient);
  pid_ = ::fork();
  if (pid_ == 0) become(pointers.data(), output, streams);
  ::close(output);
  if (pid_ < 0) throw std::runtime_error("cannot fork");
}

RunningProgram::~RunningProgram() {
  if (running()) {
    signal(SIGKILL);
    wait(std::chrono::seconds(10));
  }
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

void RunningProgram::signal(int number) const {
  if (!status_) ::kill(pid_, number);
}

std::optional<int> RunningProgram::wait(std::chrono::milliseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (!status_) {
    int raw = 0;
    const pid_t ended = ::waitpid(pid_, &raw, WNOHANG);
    if (ended == pid_) status_ = WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw);
    if (status_ || std::chrono::steady_clock::now() >= deadline) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return status_;
}

bool RunningProgram::running() { return !wait(std::chrono::milliseconds(0)); }

std::string RunningProgram::output() const {
  std::ifstream in(file_);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// Below the range from which the system takes ports for connections: tests that run beside this one take none
// of these.
Ports free_ports() {
  static std::mt19937 random{std::random_device{}()};
  std::uniform_int_distribution<int> port(10'000, 32'000);
  std::array<int, 3> ports{};
  for (std::size_t i = 0; i < 3;) {
    const int candidate = port(random);
    if (std::ranges::find(ports, candidate) != ports.end()) continue;
    const int own = ::socket(AF_INET, (i == 0 ? SOCK_DGRAM : SOCK_STREAM) | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(candidate));
    if (::bind(own, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) ports[i++] = candidate;
    ::close(own);
  }
  return {ports[0], ports[1], ports[2]};
}

}  // namespace longreach
