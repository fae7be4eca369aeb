// An adapter of a robot, to copy: what stands in Robot is to be replaced by calls to your controller; the
// rest keeps the rules of common/link/adapter_datagram.hpp. Here the robot is simulated: that of
// deploy/robots/cartesian.txtpb, whose first three joints move the tool along z, y and x, and a wall of
// 1000 N/m that it meets on its way along x.
//
//   longreach-reference-robot PORT [--wall METRES]     port 0: any free one; prints where it listens
//   longreach-slave --adapter 127.0.0.1:PORT --set robot_file=robots/cartesian.txtpb

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <random>
#include <thread>

#include "common/link/adapter_datagram.hpp"

namespace {

using namespace longreach::adapter;

constexpr double kPeriod_s = 1e-3;  // of this loop

/// Your robot.
class Robot {
 public:
  explicit Robot(double wall_m) : wall_m_(wall_m) {}

  /// Where the joints go until the next call.
  void follow(const double (&joint_rad)[kJoints]) {
    std::copy_n(joint_rad, kJoints, setpoint_m_);
    stopped_ = false;
  }
  /// The joints stay where they are.
  void stop() {
    if (!stopped_) std::copy_n(joint_m_, kJoints, setpoint_m_);
    stopped_ = true;
  }

  /// What encoders and force sensor say. Here a step of the simulation: servos of 10 Hz, 0.5 m/s at most.
  void read(RobotDatagram& out) {
    for (int i = 0; i < 3; ++i) {
      constexpr double kServo_per_s = 2.0 * std::numbers::pi * 10.0, kFastest_m_per_s = 0.5;
      const double speed = stopped_ ? 0.0 : kServo_per_s * (setpoint_m_[i] - joint_m_[i]);
      speed_m_per_s_[i] = std::clamp(speed, -kFastest_m_per_s, kFastest_m_per_s);
      joint_m_[i] += kPeriod_s * speed_m_per_s_[i];
    }
    const double depth_m = joint_m_[2] - wall_m_;
    const double push_n = depth_m > 0.0 ? 1000.0 * depth_m * (1.0 + 0.1 * speed_m_per_s_[2]) : 0.0;
    out.flags = RobotDatagram::kOk | (stopped_ ? RobotDatagram::kStopped : 0U);
    std::copy_n(joint_m_, kJoints, out.joint_rad);
    std::copy_n(speed_m_per_s_, kJoints, out.joint_rad_per_s);
    out.force_n[2] = -std::max(0.0, push_n);  // z of the tool is x of the world
  }

 private:
  double wall_m_;
  bool stopped_ = true;
  double setpoint_m_[kJoints] = {}, joint_m_[kJoints] = {}, speed_m_per_s_[kJoints] = {};
};

/// The port that longreach sends to, and where it sends from.
class Socket {
 public:
  explicit Socket(int port) : fd_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in own{};
    own.sin_family = AF_INET;
    own.sin_port = htons(static_cast<std::uint16_t>(port));
    own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::bind(fd_, reinterpret_cast<sockaddr*>(&own), sizeof own) != 0) {
      std::perror("cannot listen");
      std::exit(1);
    }
    socklen_t size = sizeof own;
    ::getsockname(fd_, reinterpret_cast<sockaddr*>(&own), &size);
    std::printf("listening on 127.0.0.1:%d\n", ntohs(own.sin_port));
    std::fflush(stdout);
  }
  ~Socket() { ::close(fd_); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  /// The next datagram that is one; false: nothing more has come. Never waits.
  template <class Datagram>
  bool receive(Datagram& out, sockaddr_in& from) const {
    unsigned char bytes[2048];
    for (;;) {
      socklen_t size = sizeof from;
      const ssize_t n =
          ::recvfrom(fd_, bytes, sizeof bytes, MSG_DONTWAIT, reinterpret_cast<sockaddr*>(&from), &size);
      if (n < 0) return false;
      if (decode(bytes, static_cast<std::size_t>(n), out)) return true;
    }
  }

  template <class Datagram>
  void send(const Datagram& datagram, const sockaddr_in& to) const {
    ::sendto(fd_, &datagram, sizeof datagram, 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }

 private:
  int fd_;
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

[[noreturn]] void serve(int port, double wall_m) {
  const Socket socket(port);
  Exchange exchange(draw_session());
  Robot robot(wall_m);
  sockaddr_in longreach{};
  const sched_param priority{.sched_priority = 40};
  sched_setscheduler(0, SCHED_FIFO, &priority);  // where the system permits it
  auto due = std::chrono::steady_clock::now();
  for (;;) {
    SetpointDatagram in;
    sockaddr_in from{};
    while (socket.receive(in, from)) {
      if (!exchange.accept(in.header, now_ns())) continue;
      longreach = from;
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
      socket.send(out, longreach);
    }
    due = std::max(due + std::chrono::milliseconds(1),
                   std::chrono::steady_clock::now() - std::chrono::milliseconds(5));
    std::this_thread::sleep_until(due);
  }
}

/// 0 to 65535; -1: it is none.
int port_of(const char* text) {
  char* end = nullptr;
  const long port = std::strtol(text, &end, 10);
  return end != text && *end == '\0' && port >= 0 && port <= 65535 ? static_cast<int>(port) : -1;
}

/// NaN: it is none.
double number_of(const char* text) {
  char* end = nullptr;
  const double number = std::strtod(text, &end);
  return end != text && *end == '\0' && std::isfinite(number) ? number : NAN;
}

}  // namespace

int main(int argc, char** argv) {
  const bool placed = argc == 4 && std::strcmp(argv[2], "--wall") == 0;
  const int port = argc == 2 || placed ? port_of(argv[1]) : -1;
  const double way_m = placed ? number_of(argv[3]) : 0.1;
  if (port < 0 || std::isnan(way_m)) {
    std::fprintf(
        stderr,
        "usage: longreach-reference-robot PORT [--wall METRES], PORT from 0 (any free one) to 65535\n");
    return 2;
  }
  serve(port, way_m);
}
