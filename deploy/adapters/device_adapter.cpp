// An example adapter for a haptic device. Copy it and replace the content of the class Device with calls to
// your hardware; the rest implements the rules of common/link/adapter_datagram.hpp. Here the device is
// simulated: a handle with three degrees of freedom, held by a hand that rests at home or, with --push,
// pushes along x and returns.
//
//   g++ -std=c++14 -O2 -I . device_adapter.cpp -o device-adapter    (with common/link/adapter_datagram.hpp in
//   .)
//
//   longreach-reference-device /run/user/1000/device [--push METRES]
//   longreach-master --adapter unix:/run/user/1000/device

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

/// Your hardware. The values are those of deploy/devices/desktop.txtpb with a light hand.
class Device {
 public:
  explicit Device(double push_m) : push_m_(push_m) {}

  /// Commands the force on the hand, which the motors apply until the next call.
  void write(const double (&force_n)[3]) { std::copy_n(force_n, 3, force_n_); }

  /// Reads the encoders. Here it advances the simulation by one step.
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
  /// Target of the hand along x, m: at home for 5 s, out and back for 5 s.
  double hand() const { return push_m_ * std::max(0.0, -std::sin(2.0 * kPi * time_s_ / 10.0)); }

  double push_m_;
  double time_s_ = 0.0;
  double force_n_[3] = {}, x_m_[3] = {}, v_m_per_s_[3] = {};
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

[[noreturn]] void serve(const char* path, double push_m) {
  Socket socket(path);
  Exchange exchange(draw_session());
  Device device(push_m);
  sched_param priority{};
  priority.sched_priority = 40;
  sched_setscheduler(0, SCHED_FIFO, &priority);  // if the system permits it
  auto due = std::chrono::steady_clock::now();
  for (;;) {
    WrenchDatagram in;
    while (socket.receive(in)) {
      if (!exchange.accept(in.header, now_ns())) continue;
      const double none[3] = {};
      device.write((in.flags & WrenchDatagram::kLive) != 0 ? in.force_n : none);
    }
    if (exchange.silent(now_ns())) device.write({0.0, 0.0, 0.0});  // the watchdog
    HandleDatagram out;
    device.read(out);
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
  const bool pushes = argc == 4 && std::strcmp(argv[2], "--push") == 0;
  const double way_m = pushes ? number_of(argv[3]) : 0.0;
  if ((argc != 2 && !pushes) || argv[1][0] != '/' || std::isnan(way_m)) {
    std::fputs("usage: longreach-reference-device PATH [--push METRES] (PATH: absolute path of the socket)\n",
               stderr);
    return 2;
  }
  serve(argv[1], way_m);
}
