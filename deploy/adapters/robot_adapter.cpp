// An example adapter for a robot. Copy it and replace the content of the class Robot with calls to your
// controller; the rest implements the rules of common/link/adapter_datagram.hpp. Here the robot is simulated:
// it is that of deploy/robots/cartesian.txtpb, whose first three joints move the tool along z, y and x, with
// a wall of 1000 N/m in the direction of x.
//
//   g++ -std=c++14 -O2 -I . robot_adapter.cpp -o robot-adapter    (with common/link/adapter_datagram.hpp in
//   .)
//
//   longreach-reference-robot /run/user/1000/robot [--wall METRES]
//   longreach-slave --adapter unix:/run/user/1000/robot --set robot_file=robots/cartesian.txtpb

#include <sched.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <thread>

#include "common/link/adapter_datagram.hpp"

namespace {

using namespace longreach::adapter;

constexpr double kPeriod_s = 1e-3;  // period of this loop
constexpr double kPi = 3.141592653589793;

/// Your robot.
class Robot {
 public:
  explicit Robot(double wall_m) : wall_m_(wall_m) {}

  /// Sets the setpoint of the joints until the next call.
  void follow(const double (&joint_rad)[kJoints]) {
    std::copy_n(joint_rad, kJoints, setpoint_m_);
    stopped_ = false;
  }
  /// Stops the joints at their present positions.
  void stop() {
    if (!stopped_) std::copy_n(joint_m_, kJoints, setpoint_m_);
    stopped_ = true;
  }

  /// Reads the encoders and the force sensor. Here it advances the simulation by one step, with servos of 10
  /// Hz and a maximum speed of 0.5 m/s.
  void read(RobotDatagram& out) {
    for (int i = 0; i < 3; ++i) {
      constexpr double kServo_per_s = 2.0 * kPi * 10.0, kFastest_m_per_s = 0.5;
      const double speed = stopped_ ? 0.0 : kServo_per_s * (setpoint_m_[i] - joint_m_[i]);
      speed_m_per_s_[i] = std::min(std::max(speed, -kFastest_m_per_s), kFastest_m_per_s);
      joint_m_[i] += kPeriod_s * speed_m_per_s_[i];
    }
    const double depth_m = joint_m_[2] - wall_m_;
    const double push_n = depth_m > 0.0 ? 1000.0 * depth_m * (1.0 + 0.1 * speed_m_per_s_[2]) : 0.0;
    out.flags = RobotDatagram::kOk | (stopped_ ? RobotDatagram::kStopped : 0U);
    std::copy_n(joint_m_, kJoints, out.joint_rad);
    std::copy_n(speed_m_per_s_, kJoints, out.joint_rad_per_s);
    // The noise of the sensor shows that it works; without it, the slave refuses to engage.
    for (double& force_n : out.force_n) force_n = 0.05 * noise_(random_);
    for (double& moment_nm : out.moment_nm) moment_nm = 0.005 * noise_(random_);
    out.force_n[2] -= std::max(0.0, push_n);  // z of the tool frame is x of the world frame
  }

 private:
  std::mt19937 random_{1};
  std::normal_distribution<double> noise_{0.0, 1.0};
  double wall_m_;
  bool stopped_ = true;
  double setpoint_m_[kJoints] = {}, joint_m_[kJoints] = {}, speed_m_per_s_[kJoints] = {};
};

/// The socket at the path that longreach connects to. It accepts one program at a time, of this user or of
/// root.
class Socket {
 public:
  explicit Socket(const char* path) : fd_(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0)) {
    sockaddr_un own{};
    own.sun_family = AF_UNIX;
    std::strncpy(own.sun_path, path, sizeof own.sun_path - 1);
    const auto* address = reinterpret_cast<const sockaddr*>(&own);
    const int other = ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0);
    const bool taken = ::connect(other, address, sizeof own) == 0 || errno == EAGAIN;
    ::close(other);
    if (!taken && is_socket(path)) ::unlink(path);  // left over from a process that has ended
    ::umask(077);                                   // no other user may connect
    if (taken || ::bind(fd_, address, sizeof own) != 0 || ::listen(fd_, 1) != 0) {
      std::fprintf(stderr, "cannot listen on %s: %s\n", path,
                   taken ? "another process is already listening there" : std::strerror(errno));
      std::exit(1);
    }
    std::printf("listening on unix:%s\n", path);
    std::fflush(stdout);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  /// Receives the next valid datagram. Returns false if there is none. Never blocks.
  template <class Datagram>
  bool receive(Datagram& out) {
    unsigned char bytes[2048];
    while (peer_ >= 0 || accept()) {
      const ssize_t n = ::recv(peer_, bytes, sizeof bytes, MSG_DONTWAIT);
      if (n < 0 && errno == EAGAIN) return false;
      if (n <= 0) leave();
      if (n > 0 && decode(bytes, static_cast<std::size_t>(n), out)) return true;
    }
    return false;
  }

  template <class Datagram>
  void send(const Datagram& datagram) const {
    if (peer_ >= 0) ::send(peer_, &datagram, sizeof datagram, MSG_DONTWAIT | MSG_NOSIGNAL);
  }

 private:
  static bool is_socket(const char* path) {
    struct stat found {};
    return ::stat(path, &found) == 0 && S_ISSOCK(found.st_mode);
  }
  bool accept() {
    peer_ = ::accept4(fd_, nullptr, nullptr, SOCK_NONBLOCK);
    ucred who{};
    socklen_t size = sizeof who;
    if (peer_ >= 0 && (::getsockopt(peer_, SOL_SOCKET, SO_PEERCRED, &who, &size) != 0 ||
                       (who.uid != ::geteuid() && who.uid != 0)))
      leave();
    return peer_ >= 0;
  }
  void leave() {
    ::close(peer_);
    peer_ = -1;
  }

  int fd_, peer_ = -1;
};

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::uint64_t draw_session() {
  std::random_device random;
  return (std::uint64_t{random()} << 32U | random()) | 1U;
}

[[noreturn]] void serve(const char* path, double wall_m) {
  Socket socket(path);
  Exchange exchange(draw_session());
  Robot robot(wall_m);
  sched_param priority{};
  priority.sched_priority = 40;
  sched_setscheduler(0, SCHED_FIFO, &priority);  // if the system permits it
  auto due = std::chrono::steady_clock::now();
  for (;;) {
    SetpointDatagram in;
    while (socket.receive(in)) {
      if (!exchange.accept(in.header, now_ns())) continue;
      if ((in.flags & SetpointDatagram::kMove) != 0) {
        robot.follow(in.joint_rad);
      } else {
        robot.stop();
      }
    }
    if (exchange.silent(now_ns())) robot.stop();  // the watchdog
    RobotDatagram out;
    robot.read(out);
    if (exchange.sessions() > 0) {
      exchange.stamp(out);
      socket.send(out);
    }
    due = std::max(due + std::chrono::milliseconds(1),
                   std::chrono::steady_clock::now() - std::chrono::milliseconds(5));
    std::this_thread::sleep_until(due);
  }
}

/// Returns NaN if the text is not a finite number.
double number_of(const char* text) {
  char* end = nullptr;
  const double number = std::strtod(text, &end);
  return end != text && *end == '\0' && std::isfinite(number) ? number : NAN;
}

}  // namespace

int main(int argc, char** argv) {
  const bool placed = argc == 4 && std::strcmp(argv[2], "--wall") == 0;
  const double way_m = placed ? number_of(argv[3]) : 0.1;
  if ((argc != 2 && !placed) || argv[1][0] != '/' || std::isnan(way_m)) {
    std::fputs("usage: longreach-reference-robot PATH [--wall METRES] (PATH: absolute path of the socket)\n",
               stderr);
    return 2;
  }
  serve(argv[1], way_m);
}
