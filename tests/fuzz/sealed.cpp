// Any bodies from somebody with the key: what is accepted is finite and within its bounds, and neither the
// safety machine nor the playout comes to harm. Input: cipher, then (type, step of the sequence, length in
// two bytes, body) after each other.

#include "common/link/playout.hpp"
#include "common/wire/memory_channel.hpp"
#include "common/wire/port.hpp"
#include "slave/safety/slave_safety.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/common/wire/samples.hpp"

namespace longreach::fuzz {
namespace {

constexpr std::size_t kRecordBytes = 4;

bool within(const Vector3& v, double bound) { return v.allFinite() && v.cwiseAbs().maxCoeff() <= bound; }

void judge(const MotionCommand& c) {
  require(c.request <= Request::kLetGo && c.mode <= MotionMode::kPosition, "levels are known");
  require(c.scale >= kScaleMin && c.scale <= kScaleMax, "the scale is within its range");
  require(within(c.position_m, kGoalMaxM) && within(c.rotation_rad, kGoalMaxRad), "a goal is possible");
}

void judge(const ContactReport& c) {
  for (const ReportedSurface& s : c.surfaces) {
    if (s.touch == 0) continue;
    require(std::abs(s.normal.norm() - 1.0) < 1e-6, "a normal is unit");
    require(s.stiffness >= 0.0 && s.stiffness <= kStiffnessMaxNPerM, "a stiffness is possible");
    require(s.foot >= 0.0 && s.foot <= kGoalMaxM && std::abs(s.offset) <= kGoalMaxM, "a place is possible");
    require(std::isfinite(s.touch_sequence) && s.touch_sequence >= 0.0, "a touch sequence is a number");
  }
}

void judge(const StiffnessReport& r) {
  require(r.state <= SafetyState::kFault, "a state is known");
  judge(r.translation);
  judge(r.rotation);
}

void judge(const Telemetry& t) {
  require(t.state <= SafetyState::kFault, "a state is known");
  require(t.X_WE.p.allFinite() && t.X_WE_goal.p.allFinite() && t.F_E_W.force.allFinite() &&
              t.F_E_W.moment.allFinite(),
          "telemetry is finite");
  require(std::abs(t.X_WE.q.norm() - 1.0) < 1e-6 && std::abs(t.X_WE_goal.q.norm() - 1.0) < 1e-6,
          "an orientation is a unit quaternion");
}

void judge(const BodyPoses& b) {
  for (const auto& body : b.body) {
    if (!body) continue;
    require(within(body->X_WB.p, kBodyMaxM), "the position of a body is possible");
    require(std::abs(body->X_WB.q.norm() - 1.0) < 1e-6, "the orientation of a body is a unit quaternion");
    require(body->age_s >= 0.0 && body->age_s <= kBodyAgeMaxS, "the age of a body is possible");
  }
}

/// What the slave makes of its commands before any of them moves it.
class Slave {
 public:
  void step(Time now, std::span<const Received<MotionCommand>> commands) {
    SlaveSafetyInput in;
    in.now = now;
    in.last_heard = now;
    in.peer_session_count = 1;
    for (const auto& received : commands) {
      const MotionCommand& c = received.message;
      judge(c);
      playout_.push(now, received.sent, received.sequence, c.position_m);
      if (!received.newest) continue;
      in.commanded = true;
      in.engagement = c.engagement;
      in.request = c.request;
      in.echo_sent = received.echo_sent;
      stopped_ = stopped_ || c.request == Request::kStop;
    }
    const bool begun = safety_.step(in);
    require(!begun || in.request == Request::kEngage, "only a request engages");
    require(!stopped_ || begun || safety_.state() != SafetyState::kEngaged || engaged_since_stop_,
            "a stop is latched until an engagement");
    if (begun) engaged_since_stop_ = true;
    if (in.commanded && in.request == Request::kStop) engaged_since_stop_ = false;
    if (const auto played = playout_.play(now)) {
      require(played->goal.allFinite(), "a played goal is finite");
      require(played->sequence >= last_, "playout never goes back");
      last_ = played->sequence;
    }
  }

  void clear() {
    playout_.clear();
    safety_ = SlaveSafety({});
    last_ = 0.0;
    stopped_ = engaged_since_stop_ = false;
  }

 private:
  SlaveSafety safety_{SlaveSafetyConfig{}};
  Playout playout_;
  double last_ = 0.0;
  bool stopped_ = false, engaged_since_stop_ = false;
};

struct Sides {
  MemoryChannelPair channels{64};
  MasterPort master{channels.a(), ImpairmentConfig{}, Random(1)};
  SlavePort slave{channels.b(), ImpairmentConfig{}, Random(2)};
  Slave behind;

  void run(Cipher cipher, std::span<const std::byte> rest) {
    const Session session = samples::session(1000, cipher);
    master.follow(session);
    slave.follow(session);
    behind.clear();
    const Seal to_slave(session, Way::kToSlave), to_master(session, Way::kToMaster);
    std::uint64_t sequence = 1;
    for (int i = 1; rest.size() >= kRecordBytes && i <= 32; ++i) {
      const auto type = static_cast<DatagramType>(1 + std::to_integer<int>(rest[0]) % 4);
      sequence += std::to_integer<std::uint64_t>(rest[1]);
      const auto length = std::min(length_of(rest.subspan(2)), rest.size() - kRecordBytes);
      const auto body = rest.subspan(kRecordBytes, std::min(length, kBodyMaxBytes));
      const bool up = type == DatagramType::kMotionCommand;
      send(up ? channels.a() : channels.b(), up ? to_slave : to_master,
           {.type = type, .session = session.number, .sequence = sequence}, body);
      rest = rest.subspan(kRecordBytes + length);
      const Time now{std::chrono::milliseconds(5 * i)};
      slave.receive(now);
      master.receive(now);
      behind.step(now, slave.commands());
      for (const auto& report : master.reports()) judge(report.message);
      for (const auto& telemetry : master.telemetry()) judge(telemetry.message);
      for (const auto& bodies : master.bodies()) judge(bodies.message);
    }
  }

  static void send(Channel& channel, const Seal& seal, const Header& header,
                   std::span<const std::byte> body) {
    std::array<std::byte, kDatagramMaxBytes> datagram{};
    write_header(header, datagram);
    std::copy(body.begin(), body.end(), datagram.begin() + kHeaderBytes);
    const auto sealed = std::span(datagram).subspan(kHeaderBytes, body.size() + kTagBytes);
    seal.close({.type = static_cast<std::uint8_t>(header.type), .sequence = header.sequence},
               std::span(datagram).first(kHeaderBytes), sealed);
    channel.send(std::span(datagram).first(kHeaderBytes + sealed.size()));
  }
};

}  // namespace
}  // namespace longreach::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace longreach;
  static fuzz::Sides sides;
  if (size == 0) return 0;
  const bool aes = (bytes[0] & 1) != 0 && has_aes256gcm();
  sides.run(aes ? Cipher::kAes256Gcm : Cipher::kChaCha20Poly1305,
            std::as_bytes(std::span(bytes, size)).subspan(1));
  return 0;
}
