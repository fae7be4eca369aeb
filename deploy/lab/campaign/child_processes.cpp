#include "deploy/lab/campaign/child_processes.hpp"

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <stdexcept>

namespace longreach {
namespace {

/// Blocks the relevant signals during its lifetime and returns them one by one.
class Signals {
 public:
  Signals() {
    std::signal(SIGCHLD, SIG_DFL);
    sigemptyset(&set_);
    for (const int number : {SIGCHLD, SIGINT, SIGTERM, SIGHUP}) sigaddset(&set_, number);
    sigprocmask(SIG_BLOCK, &set_, &before_);
  }
  ~Signals() {
    while (next(0) > 0) {
    }
    restore();
  }
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  /// Returns the number of the next signal, or 0 or less if there was none.
  int next(time_t seconds) const {
    const timespec timeout{.tv_sec = seconds, .tv_nsec = 0};
    return sigtimedwait(&set_, nullptr, &timeout);
  }
  void restore() const { sigprocmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t set_{}, before_{};
};

struct Child {
  pid_t pid = -1;
  std::size_t job = 0;
  int said = -1;  // file with the output of the child
};

[[noreturn]] void become_child(const Child& child, const Signals& signals, pid_t parent,
                               const ChildWork& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  setpgid(0, 0);  // Ctrl-C must reach only the parent
  signals.restore();
  dup2(child.said, STDOUT_FILENO);
  dup2(child.said, STDERR_FILENO);
  int status = 0;
  try {
    work.run(child.job);
  } catch (const std::exception& e) {
    std::fflush(nullptr);
    std::fprintf(stderr, "\n%s\n", e.what());
    status = 1;
  }
  std::fflush(nullptr);
  _exit(status);
}

std::string last_line(int file) {
  std::array<char, 2000> text{};
  const off_t end = lseek(file, 0, SEEK_END);
  const off_t begin = std::max<off_t>(0, end - static_cast<off_t>(text.size()));
  const ssize_t size = pread(file, text.data(), text.size(), begin);
  std::string line(text.data(), static_cast<std::size_t>(std::max<ssize_t>(0, size)));
  line.erase(line.find_last_not_of(" \r\n") + 1);
  return line.substr(line.find_last_of('\n') + 1);
}

std::string failure_of(const Child& child, int status) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
  const std::string said = last_line(child.said);
  if (WIFEXITED(status)) return said.empty() ? "the process failed without an error message" : said;
  const std::string ended =
      std::string("the process was terminated by a signal (") + strsignal(WTERMSIG(status)) + ")";
  return said.empty() ? ended : ended + ": " + said;
}

class Children {
 public:
  explicit Children(const ChildWork& work) : work_(work) {}
  ~Children() {
    for (const Child& child : running_) {
      kill(-child.pid, SIGKILL);
      kill(child.pid, SIGKILL);  // in case the child has no process group of its own yet
      waitpid(child.pid, nullptr, 0);
      close(child.said);
    }
  }
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;

  [[nodiscard]] std::size_t running() const { return running_.size(); }

  /// Returns false if the system cannot start another process now.
  bool start(std::size_t job, const Signals& signals) {
    Child child{.job = job, .said = memfd_create("cell", MFD_CLOEXEC)};
    if (child.said < 0) return false;
    std::fflush(nullptr);  // otherwise the child would print the buffer again
    const pid_t parent = getpid();
    child.pid = fork();
    if (child.pid == 0) become_child(child, signals, parent, work_);
    if (child.pid < 0) {
      close(child.said);
      return false;
    }
    running_.push_back(child);
    return true;
  }

  void reap() {
    std::erase_if(running_, [this](const Child& child) {
      int status = 0;
      if (waitpid(child.pid, &status, WNOHANG) != child.pid) return false;
      work_.ended(child.job, failure_of(child, status));
      close(child.said);
      return true;
    });
  }

 private:
  const ChildWork& work_;
  std::vector<Child> running_;
};

}  // namespace

int run_in_children(const std::vector<std::size_t>& jobs, std::size_t at_a_time, const ChildWork& work) {
  const Signals signals;
  Children children(work);
  std::size_t next = 0;
  while (next < jobs.size() || children.running() > 0) {
    while (next < jobs.size() && children.running() < at_a_time && children.start(jobs[next], signals))
      ++next;
    if (children.running() == 0)
      throw std::runtime_error(
          "cannot start a process; check whether enough "
          "memory is available");
    const int signal = signals.next(1);
    if (signal > 0 && signal != SIGCHLD) return signal;
    children.reap();
    work.waited();
  }
  return 0;
}

}  // namespace longreach
