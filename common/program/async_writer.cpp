#include "common/program/async_writer.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <deque>
#include <mutex>
#include <utility>

namespace longreach {
namespace {

constexpr int kLook_ms = 20;

}  // namespace

struct AsyncWriter::State {
  State(int own_fd, std::size_t most, Gap in_place) : fd(own_fd), bytes_max(most), gap(std::move(in_place)) {}
  ~State() {
    if (fd >= 0) ::close(fd);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void run();
  bool write(std::string_view text);
  void drop_oldest() {
    waiting_bytes -= waiting.front().size();
    waiting.pop_front();
  }
  [[nodiscard]] bool quiet() const { return waiting.empty() && !writing; }

  const int fd;
  const std::size_t bytes_max;
  const Gap gap;
  mutable std::mutex mutex;
  std::condition_variable more, done;
  std::deque<std::string> waiting;
  std::size_t waiting_bytes = 0;
  bool writing = false;
  bool ended = false;
  std::atomic<bool> dropped{false};  // what is being written, if it waits
  bool torn = false;                 // the last text was cut; the thread's own
  std::uint64_t lost = 0;
  std::uint64_t reported = 0;  // of those lost
};

void AsyncWriter::State::run() {
  sigset_t all;
  sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, nullptr);  // a reader that has gone is an error, not the end
  std::unique_lock lock(mutex);
  while (true) {
    more.wait(lock, [this] { return ended || !waiting.empty(); });
    if (waiting.empty()) return;
    const std::string text = std::move(waiting.front());
    waiting_bytes -= text.size();
    waiting.pop_front();
    writing = true;
    const std::uint64_t missing = lost - reported;
    const std::uint64_t now_reported = lost;
    dropped = false;
    lock.unlock();
    const bool written = (missing == 0 || !gap || write(gap(missing))) && write(text);
    lock.lock();
    writing = false;
    if (written) reported = now_reported;
    if (!written) ++lost;
    done.notify_all();
  }
}

bool AsyncWriter::State::write(std::string_view text) {
  const std::string whole = (torn ? "\n" : "") + std::string(text);
  std::string_view rest = whole;
  while (!rest.empty()) {
    const ssize_t n = ::write(fd, rest.data(), rest.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno == EAGAIN && !dropped) {  // of a descriptor that never waits
      pollfd room{fd, POLLOUT, 0};
      (void)::poll(&room, 1, kLook_ms);
      continue;
    }
    if (n <= 0) break;
    torn = true;
    rest.remove_prefix(static_cast<std::size_t>(n));
  }
  if (rest.empty()) torn = false;
  return rest.empty();
}

AsyncWriter::AsyncWriter(int fd, std::size_t bytes_max, Gap gap)
    : state_(std::make_shared<State>(::fcntl(fd, F_DUPFD_CLOEXEC, 3), bytes_max, std::move(gap))),
      thread_([state = state_] { state->run(); }) {}

AsyncWriter::~AsyncWriter() {
  std::unique_lock lock(state_->mutex);
  state_->ended = true;
  state_->more.notify_all();
  const bool all = state_->done.wait_for(lock, kFarewell, [this] { return state_->quiet(); });
  state_->waiting.clear();
  state_->dropped = true;
  lock.unlock();
  if (all) thread_.join();
  if (!all) thread_.detach();
}

void AsyncWriter::offer(std::string text) {
  const std::lock_guard lock(state_->mutex);
  state_->waiting_bytes += text.size();
  state_->waiting.push_back(std::move(text));
  while (state_->waiting_bytes > state_->bytes_max && state_->waiting.size() > 1) {
    state_->drop_oldest();
    ++state_->lost;
  }
  state_->more.notify_one();
}

void AsyncWriter::clear() {
  const std::lock_guard lock(state_->mutex);
  while (!state_->waiting.empty()) state_->drop_oldest();
  state_->dropped = true;
}

bool AsyncWriter::drain(std::chrono::milliseconds timeout) {
  std::unique_lock lock(state_->mutex);
  return state_->done.wait_for(lock, timeout, [this] { return state_->quiet(); });
}

std::uint64_t AsyncWriter::lost() const {
  const std::lock_guard lock(state_->mutex);
  return state_->lost;
}

namespace {

/// What is not taken is left out.
ssize_t last_words(void*, const char* text, std::size_t size) {
  constexpr int kTimeout_ms = 200;
  pollfd room{STDERR_FILENO, POLLOUT, 0};
  if (::poll(&room, 1, kTimeout_ms) > 0 && (room.revents & POLLOUT) != 0)
    (void)!::write(STDERR_FILENO, text, std::min<std::size_t>(size, PIPE_BUF));
  return static_cast<ssize_t>(size);
}

}  // namespace

void bound_standard_error() {
  std::FILE* const bounded = ::fopencookie(nullptr, "w", {nullptr, last_words, nullptr, nullptr});
  if (bounded == nullptr) return;
  (void)std::setvbuf(bounded, nullptr, _IONBF, 0);
  stderr = bounded;
}

bool put(int fd, std::string_view text) {
  AsyncWriter async_writer(fd, text.size());
  async_writer.offer(std::string(text));
  return async_writer.drain(AsyncWriter::kFarewell) && async_writer.lost() == 0;
}

}  // namespace longreach
