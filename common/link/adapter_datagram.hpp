#pragma once
// The adapter protocol, version 1. With it, your program gives longreach access to a haptic device or a
// robot. Copy this file; it needs only C++14 and its standard library. deploy/adapters contains an example of
// each kind with the command that compiles it, and `longreach adapter check` tests your adapter.
//
// The adapter and longreach run on the same machine and exchange datagrams over a Unix socket
// (SOCK_SEQPACKET). Your adapter listens at a path that only its user may access (mode 0600). longreach
// connects to unix:/PATH, as that user or as root. Each end checks the user ID of the other end (SO_PEERCRED)
// and closes the socket if that user is not allowed. longreach sends one datagram in every tick of its loop
// (1000 per second by default, loop.rate_hz). Your adapter sends 500 to 4000 datagrams per second, timed by
// its own clock or in response to the received datagrams. It serves one program at a time; after a disconnect
// it accepts the next one that connects.
//
//   haptic device   longreach -> adapter   WrenchDatagram      adapter -> longreach   HandleDatagram
//   robot           longreach -> adapter   SetpointDatagram    adapter -> longreach   RobotDatagram
//   robot that tracks free bodies, in addition                 adapter -> longreach   BodiesDatagram, optional
//
// All numbers are little-endian, and doubles are IEEE 754; no struct has padding. Units are SI units and
// radians. Frames: M is the base of the device, H its handle, W the world frame of the robot, E its tool.
//
// Both ends follow these rules:
//   1  A datagram with a wrong size, magic, version or kind, or with a number that is not finite, is
//      ignored. Unknown flags are ignored; send them as 0.
//   2  Each end draws a non-zero session number when it starts, and numbers its datagrams 1, 2, 3, ...
//      `echo` is the number of the newest datagram accepted from the other end, or 0 before the first.
//   3  Within a session, a datagram is valid only if its number is greater than all previous ones. A
//      different session is accepted only after 20 ms without a valid datagram of the current session: one
//      program at a time, and restarts are possible.
//   4  Watchdog: after 20 ms without a valid datagram, a device renders no wrench and a robot stops at its
//      present position. Both keep sending for at least a second, and resume with the next valid datagram.
//   5  An adapter that has failed clears its flag kOk and keeps sending. longreach treats 20 ms without a
//      datagram, or a datagram without kOk, as a fault of the device or robot, and holds. A BodiesDatagram
//      does not count for this.
//
// Versions of longreach that do not know BodiesDatagram count it as malformed and are otherwise not affected; only
// their `longreach adapter check` reports it, and the gap that it leaves in the numbers.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace longreach {
namespace adapter {

#if !defined(__BYTE_ORDER__) || __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "this machine is not little-endian: swap the bytes of every number"
#endif

constexpr std::uint8_t kVersion = 1;
constexpr std::int64_t kWatchdog_ns = 20'000'000;

enum Kind : std::uint8_t { kHandle = 1, kWrench = 2, kSetpoint = 3, kRobot = 4, kBodies = 5 };

struct Header {
  char magic[4] = {'L', 'R', 'A', 'P'};
  std::uint8_t version = kVersion;
  std::uint8_t kind = 0;
  std::uint16_t size = 0;  // size of the whole datagram, bytes
  std::uint64_t session = 0;
  std::uint64_t sequence = 0;
  std::uint64_t echo = 0;
};

/// Sent by a device adapter to longreach.
struct HandleDatagram {
  static constexpr std::uint8_t kKind = kHandle;
  enum Flag : std::uint32_t {
    kOk = 1,    // the device works
    kHeld = 2,  // a hand is on the handle; devices without a hand sensor always set this flag
    // Buttons, set while they are pressed.
    kMode = 4,        // switches between rate and position mode
    kScaleUp = 8,     // coarser motion
    kScaleDown = 16,  // finer motion
    kClutch = 32,     // the handle moves without the robot
    kKvUp = 64,       // faster motion in rate mode
    kKvDown = 128     // slower motion in rate mode
  };
  Header header{};
  std::uint32_t flags = 0;
  std::uint32_t reserved = 0;
  double position_m[3] = {};               // position of H relative to its home, in M
  double orientation[4] = {1.0, 0, 0, 0};  // orientation of H in M, unit quaternion w x y z; home is 1 0 0 0
  double velocity_m_per_s[3] = {};         // velocity of H in M
  double angular_rad_per_s[3] = {};        // angular velocity of H in M
  double force_n[3] = {};                  // commanded motor force on the hand, in M
  double moment_nm[3] = {};                // commanded motor moment on the hand, in M
};

/// Sent by longreach to a device adapter.
struct WrenchDatagram {
  static constexpr std::uint8_t kKind = kWrench;
  enum Flag : std::uint32_t {
    kLive = 1  // render the wrench; without this flag, render no wrench
  };
  Header header{};
  std::uint32_t flags = 0;
  std::uint32_t reserved = 0;
  double force_n[3] = {};    // force on the hand, in M
  double moment_nm[3] = {};  // moment on the hand, in M
};

constexpr int kJoints = 6;

/// Sent by longreach to a robot adapter.
struct SetpointDatagram {
  static constexpr std::uint8_t kKind = kSetpoint;
  enum Flag : std::uint32_t {
    kMove = 1,  // engaged: the joints follow joint_rad; without this flag they brake and stay at rest
    kGrip = 2,  // close the gripper
    // The operator requested a gripper state; without this flag, for example after a restart of the slave,
    // the gripper keeps its state.
    kGripAsked = 4
  };
  Header header{};
  std::uint32_t flags = 0;
  std::uint32_t reserved = 0;
  double joint_rad[kJoints] = {};  // setpoints in the order of the robot file; m for a prismatic joint
};

/// Sent by a robot adapter to longreach.
struct RobotDatagram {
  static constexpr std::uint8_t kKind = kRobot;
  enum Flag : std::uint32_t {
    kOk = 1,      // the robot is operational and may be moved
    kLoad = 2,    // the gripper holds a load
    kStopped = 4  // stopped; the robot stays at rest until the next setpoint arrives
  };
  Header header{};
  std::uint32_t flags = 0;
  std::uint32_t reserved = 0;
  double joint_rad[kJoints] = {};  // measured positions; m for a prismatic joint
  /// Measured speeds; m/s for a prismatic joint.
  double joint_rad_per_s[kJoints] = {};
  /// Force of the environment on the tool, along the axes of E, with the noise of the sensor. A force that
  /// has had a single value since the start is not used, and one that stops varying is a sensor fault. For a
  /// robot without a force sensor, send 0 and start the slave with sensing.force=false; for a sensor that is
  /// simulated without noise, or coarse, set sensing.force_noise_n=0.
  double force_n[3] = {};
  /// Moment of the environment on the tool, about the origin of E; likewise. For a sensor of three axes, send
  /// 0 and set sensing.moment=false.
  double moment_nm[3] = {};
};

constexpr std::uint32_t kBodiesMost = 8;

/// The pose of a free body, such as a workpiece that a camera of the robot tracks.
struct TrackedBody {
  double position_m[3] = {};               // origin of the body's frame, in W; components up to 1e6
  double orientation[4] = {1.0, 0, 0, 0};  // of the body's frame in W, unit quaternion w x y z
  double age_s = 0.0;                      // time since the measurement; negative: the pose is unknown
};

/// Sent by a robot adapter to longreach if the robot tracks free bodies, usually 30 times per second. longreach shows and
/// records the poses; nothing moves by them. An adapter of a robot that tracks nothing never sends this datagram. Its
/// number and session are those of the RobotDatagrams: both kinds are numbered together (rule 2).
struct BodiesDatagram {
  static constexpr std::uint8_t kKind = kBodies;
  Header header{};
  std::uint32_t count = 0;  // tracked bodies, up to kBodiesMost
  std::uint32_t reserved = 0;
  /// The first `count` are the bodies; the number of a body is its place and must not change within a session. The
  /// remaining ones are ignored.
  TrackedBody body[kBodiesMost] = {};
};

static_assert(sizeof(Header) == 32 && sizeof(HandleDatagram) == 192 && sizeof(WrenchDatagram) == 88 &&
                  sizeof(SetpointDatagram) == 88 && sizeof(RobotDatagram) == 184 &&
                  sizeof(BodiesDatagram) == 552,
              "a datagram struct has padding on this machine");

template <std::size_t N>
bool finite(const double (&numbers)[N]) {
  for (const double x : numbers)
    if (!std::isfinite(x)) return false;
  return true;
}
inline bool unit(const double (&quaternion)[4]) {
  double square = 0.0;
  for (const double x : quaternion) square += x * x;
  return std::abs(square - 1.0) < 1e-3;  // false for NaN
}
inline bool finite(const HandleDatagram& d) {
  return finite(d.position_m) && unit(d.orientation) && finite(d.velocity_m_per_s) &&
         finite(d.angular_rad_per_s) && finite(d.force_n) && finite(d.moment_nm);
}
inline bool finite(const WrenchDatagram& d) { return finite(d.force_n) && finite(d.moment_nm); }
inline bool finite(const SetpointDatagram& d) { return finite(d.joint_rad); }
inline bool finite(const RobotDatagram& d) {
  return finite(d.joint_rad) && finite(d.joint_rad_per_s) && finite(d.force_n) && finite(d.moment_nm);
}
/// Also returns false if `count` is too large. The pose of a body whose pose is unknown must be finite, too.
inline bool finite(const BodiesDatagram& d) {
  if (d.count > kBodiesMost) return false;
  for (std::uint32_t i = 0; i < d.count; ++i)
    if (!finite(d.body[i].position_m) || !unit(d.body[i].orientation) || !std::isfinite(d.body[i].age_s))
      return false;
  return true;
}

/// Applies rule 1. Returns whether the datagram is well-formed; `out` is unchanged if it is not.
template <class Datagram>
bool decode(const void* bytes, std::size_t size, Datagram& out) {
  Datagram d;
  if (size != sizeof d) return false;
  const Header expected{};
  std::memcpy(&d, bytes, sizeof d);
  if (std::memcmp(d.header.magic, expected.magic, sizeof expected.magic) != 0 ||
      d.header.version != kVersion || d.header.kind != Datagram::kKind || d.header.size != sizeof d ||
      d.header.session == 0 || !finite(d))
    return false;
  out = d;
  return true;
}

/// Applies rules 2 to 4 for one end.
class Exchange {
 public:
  explicit Exchange(std::uint64_t session, std::int64_t watchdog_ns = kWatchdog_ns)
      : session_(session), watchdog_ns_(watchdog_ns) {}

  /// Returns whether this datagram is valid, and records it if it is. All times are read from one monotonic
  /// clock, ns.
  bool accept(const Header& header, std::int64_t now_ns) {
    if (header.session == peer_ ? header.sequence <= newest_ : !silent(now_ns)) return false;
    if (header.session != peer_) ++sessions_;
    peer_ = header.session;
    newest_ = header.sequence;
    received_ns_ = now_ns;
    return true;
  }

  template <class Datagram>
  /// Fills in the header of the next datagram to be sent.
  void stamp(Datagram& out) {
    out.header = {};
    out.header.kind = Datagram::kKind;
    out.header.size = sizeof out;
    out.header.session = session_;
    out.header.sequence = ++sent_;
    out.header.echo = newest_;
  }

  /// Returns true if no valid datagram has arrived within the watchdog time, or no datagram at all.
  bool silent(std::int64_t now_ns) const { return peer_ == 0 || now_ns - received_ns_ >= watchdog_ns_; }
  std::uint64_t sessions() const { return sessions_; }  // number of sessions of the other end so far

 private:
  std::uint64_t session_;
  std::int64_t watchdog_ns_;
  std::uint64_t peer_ = 0, newest_ = 0, sent_ = 0, sessions_ = 0;
  std::int64_t received_ns_ = 0;
};

}  // namespace adapter
}  // namespace longreach
