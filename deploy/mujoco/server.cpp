#include "deploy/mujoco/server.hpp"

#include <sched.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <deque>
#include <optional>
#include <random>
#include <stdexcept>
#include <thread>

#include "common/link/adapter_datagram.hpp"
#include "deploy/mujoco/tracked_bodies.hpp"

namespace longreach {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kBodies_hz = 30.0;  // poses of free bodies; their display needs no more
constexpr double kReset_s = 0.5;     // not ok after a reset

/// A listening socket that accepts one program at a time, of this user or of root.
class Listener {
 public:
  explicit Listener(const std::string& path)
      : path_(path), fd_(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    sockaddr_un own{};
    own.sun_family = AF_UNIX;
    if (path.size() >= sizeof own.sun_path)
      throw std::runtime_error(path + ": the path of a socket has at most 107 characters");
    std::memcpy(own.sun_path, path.c_str(), path.size() + 1);
    const auto* address = reinterpret_cast<const sockaddr*>(&own);
    const int other = ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    const bool taken = ::connect(other, address, sizeof own) == 0 || errno == EAGAIN;
    ::close(other);
    if (taken) throw std::runtime_error(path + ": another process is already listening there");
    struct stat found {};
    if (::stat(path.c_str(), &found) == 0 && S_ISSOCK(found.st_mode))
      ::unlink(path.c_str());  // of a process that has ended
    ::umask(077);              // no other user may connect
    if (::bind(fd_, address, sizeof own) != 0 || ::listen(fd_, 1) != 0)
      throw std::runtime_error(path + ": cannot listen: " + std::strerror(errno));
  }
  ~Listener() {
    leave();
    ::close(fd_);
    ::unlink(path_.c_str());
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  /// Receives the next valid datagram. Returns false if there is none. Never blocks.
  bool receive(adapter::SetpointDatagram& out) {
    std::array<unsigned char, 2048> bytes{};
    while (peer_ >= 0 || accept()) {
      const ssize_t n = ::recv(peer_, bytes.data(), bytes.size(), MSG_DONTWAIT);
      if (n < 0 && errno == EAGAIN) return false;
      if (n <= 0) leave();
      if (n > 0 && adapter::decode(bytes.data(), static_cast<std::size_t>(n), out)) return true;
    }
    return false;
  }
  template <class Datagram>
  void send(const Datagram& datagram) const {
    if (peer_ >= 0) (void)::send(peer_, &datagram, sizeof datagram, MSG_DONTWAIT | MSG_NOSIGNAL);
  }

 private:
  bool accept() {
    peer_ = ::accept4(fd_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    ucred who{};
    socklen_t size = sizeof who;
    if (peer_ >= 0 && (::getsockopt(peer_, SOL_SOCKET, SO_PEERCRED, &who, &size) != 0 ||
                       (who.uid != ::geteuid() && who.uid != 0)))
      leave();
    return peer_ >= 0;
  }
  void leave() {
    if (peer_ >= 0) ::close(peer_);
    peer_ = -1;
  }

  std::string path_;
  int fd_, peer_ = -1;
};

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count();
}

adapter::RobotDatagram measured(MujocoWorld& world, bool ok, bool stopped) {
  adapter::RobotDatagram out;
  out.flags = (ok ? adapter::RobotDatagram::kOk : 0U) | (stopped ? adapter::RobotDatagram::kStopped : 0U);
  std::ranges::copy(world.positions(), out.joint_rad);
  std::ranges::copy(world.speeds(), out.joint_rad_per_s);
  const Wrench wrench = world.measured();
  for (int i = 0; i < 3; ++i) out.force_n[i] = wrench.force[i], out.moment_nm[i] = wrench.moment[i];
  return out;
}

/// What is sent for one period.
struct Sent {
  adapter::RobotDatagram robot{};
  std::optional<adapter::BodiesDatagram> bodies{};
};

/// Sends what was measured, `late` periods after it was.
class Delayed {
 public:
  explicit Delayed(const ServerOptions& options)
      : late_(static_cast<std::size_t>(std::lround(options.latency_s * options.rate_hz))) {}

  void send(const Sent& measured, adapter::Exchange& exchange, const Listener& listener) {
    waiting_.push_back(measured);
    if (waiting_.size() <= late_) return;
    Sent& due = waiting_.front();
    if (exchange.sessions() > 0) {
      exchange.stamp(due.robot);
      listener.send(due.robot);
      if (due.bodies) {
        exchange.stamp(*due.bodies);
        listener.send(*due.bodies);
      }
    }
    waiting_.pop_front();
  }

 private:
  std::size_t late_;
  std::deque<Sent> waiting_;
};

/// Says which free bodies are not tracked, if any.
TrackedBodies tracked_bodies(const MujocoWorld& world) {
  TrackedBodies bodies(world.model());
  std::string names;
  for (const std::string& name : bodies.left_out()) names += (names.empty() ? "" : ", ") + name;
  if (!names.empty())
    std::fprintf(
        stderr,
        "longreach-mujoco: warning: the file has more than %u free bodies; the poses of these are not "
        "sent: %s\n",
        adapter::kBodiesMost, names.c_str());
  return bodies;
}

/// Compares the time of the simulation with that of the clock: says so where it is behind, and stops where it is far behind.
class Pace {
 public:
  void check(double simulated_s) {
    const Clock::time_point now = Clock::now();
    const double passed_s = std::chrono::duration<double>(now - begin_).count();
    simulated_s_ += simulated_s;
    if (passed_s < kWatched_s) return;
    const double share = simulated_s_ / passed_s;
    begin_ = now;
    simulated_s_ = 0.0;
    if (share > kWarned) return;
    std::array<char, 120> text{};
    std::snprintf(text.data(), text.size(),
                  "the simulation reaches %.0f %% of real time; use a simpler scene or a larger time step",
                  100.0 * share);
    if (share < kLeast) throw std::runtime_error(text.data());
    std::fprintf(stderr, "longreach-mujoco: warning: %s\n", text.data());
  }

 private:
  static constexpr double kWatched_s = 5.0, kWarned = 0.98, kLeast = 0.8;
  Clock::time_point begin_ = Clock::now();
  double simulated_s_ = 0.0;
};

}  // namespace

void serve(MujocoWorld& world, const ServerOptions& options, const std::function<ServerRequest()>& asked) {
  Listener listener(options.path);
  std::random_device device;
  adapter::Exchange exchange((std::uint64_t{device()} << 32U | device()) | 1U);
  std::printf("listening on unix:%s\n", options.path.c_str());
  std::fflush(stdout);
  const sched_param priority{.sched_priority = 40};
  sched_setscheduler(0, SCHED_FIFO, &priority);  // if the system permits it
  const double period_s = 1.0 / options.rate_hz;
  const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(period_s));
  const TrackedBodies bodies = tracked_bodies(world);
  const long bodies_periods = std::lround(options.rate_hz / kBodies_hz);
  long since_bodies = 0;  // periods
  Delayed delayed(options);
  Pace pace;
  const auto reset_periods = static_cast<long>(std::lround(kReset_s * options.rate_hz));
  long not_ok = 0;  // periods until the robot is ok again after a reset
  bool stopped = true;
  auto due = Clock::now();
  for (ServerRequest what = asked(); what != ServerRequest::kEnd; what = asked()) {
    if (what == ServerRequest::kReset) {
      world.reset();
      stopped = true;
      not_ok = reset_periods;
    }
    not_ok = std::max(0L, not_ok - 1);
    adapter::SetpointDatagram in;
    bool moves = false, heard = false;
    while (listener.receive(in)) {
      if (!exchange.accept(in.header, now_ns())) continue;
      heard = true;
      moves = not_ok == 0 && (in.flags & adapter::SetpointDatagram::kMove) != 0;
      if (moves) world.follow(in.joint_rad);
      if ((in.flags & adapter::SetpointDatagram::kGripAsked) != 0)
        world.grip((in.flags & adapter::SetpointDatagram::kGrip) != 0);
    }
    if (moves) stopped = false;
    if ((heard && !moves) || exchange.silent(now_ns())) {
      if (!stopped) world.stop();
      stopped = true;
    }
    world.step(period_s);
    Sent now{measured(world, not_ok == 0, stopped), {}};
    if (bodies.any() && ++since_bodies >= bodies_periods) {
      now.bodies = bodies.poses(world.data(), options.latency_s);
      since_bodies = 0;
    }
    delayed.send(now, exchange, listener);
    pace.check(period_s);
    due = std::max(due + period, Clock::now() - std::chrono::milliseconds(20));
    std::this_thread::sleep_until(due);
  }
}

}  // namespace longreach
