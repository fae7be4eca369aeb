// An adapter of a haptic device, to copy: what stands in Device is to be replaced by calls to your hardware;
// the rest keeps the rules of common/link/adapter_datagram.hpp. Here the device is simulated: a handle that
// moves in three directions, held by a hand that rests at home or, with --push, pushes along x and comes
// back.
//
//   longreach-reference-device PORT [--push METRES]     port 0: any free one; prints where it listens
//   longreach-master --adapter 127.0.0.1:PORT

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

/// Your hardware. The figures are those of deploy/devices/desktop.txtpb with a light hand.
class Device {
 public:
  explicit Device(double push_m) : push_m_(push_m) {}

  /// Tells the motors what to make on the hand until the next call.
  void write(const double (&force_n)[3]) { std::copy_n(force_n, 3, force_n_); }

  /// What the encoders say. Here a step of the simulation.
  void read(HandleDatagram& out) {
    time_s_ += kPeriod_s;
    for (int i = 0; i < 3; ++i) {
      constexpr double kMass_kg = 0.9, kDamping_n_s_per_m = 12.0, kHand_n_per_m = 135.0;
      const double hand_m = i == 0 ? hand() : 0.0;
      const double force_n =
          force_n_[i] + kHand_n_per_m * (hand_m - x_m_[i]) - kDamping_n_s_per_m * v_m_per_s_[i];
      v_m_per_s_[i] += kPeriod_s * force_n / kMass_kg;
      x_m_[i] += kPeriod_s * v_m_per_s_[i];
    }
    out.flags = HandleDatagram::kOk | HandleDatagram::kHeld;
    std::copy_n(x_m_, 3, out.position_m);
    std::copy_n(v_m_per_s_, 3, out.velocity_m_per_s);
    std::copy_n(force_n_, 3, out.force_n);
  }

 private:
  /// Where the hand wants the handle along x: at home for 5 s, out and back for 5 s.
  [[nodiscard]] double hand() const {
    return push_m_ * std::max(0.0, -std::sin(2.0 * std::numbers::pi * time_s_ / 10.0));
  }

  double push_m_;
  double time_s_ = 0.0;
  double force_n_[3] = {}, x_m_[3] = {}, v_m_per_s_[3] = {};
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

[[noreturn]] void serve(int port, double push_m) {
  const Socket socket(port);
  Exchange exchange(draw_session());
  Device device(push_m);
  sockaddr_in longreach{};
  const sched_param priority{.sched_priority = 40};
  sched_setscheduler(0, SCHED_FIFO, &priority);  // where the system permits it
  auto due = std::chrono::steady_clock::now();
  for (;;) {
    WrenchDatagram in;
    sockaddr_in from{};
    while (socket.receive(in, from)) {
      if (!exchange.accept(in.header, now_ns())) continue;
      longreach = from;
      const double none[3] = {};
      device.write((in.flags & WrenchDatagram::kLive) != 0 ? in.force_n : none);
    }
    if (exchange.silent(now_ns())) device.write({0.0, 0.0, 0.0});  // the watchdog
    HandleDatagram out;
    device.read(out);
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
  const bool pushes = argc == 4 && std::strcmp(argv[2], "--push") == 0;
  const int port = argc == 2 || pushes ? port_of(argv[1]) : -1;
  const double way_m = pushes ? number_of(argv[3]) : 0.0;
  if (port < 0 || std::isnan(way_m)) {
    std::fprintf(
        stderr,
        "usage: longreach-reference-device PORT [--push METRES], PORT from 0 (any free one) to 65535\n");
    return 2;
  }
  serve(port, way_m);
}
