#include "common/wire/port.hpp"

#include <numeric>

namespace longreach {
namespace {

// More than the impairment can hold: a bound, not a limit that is met.
constexpr int kPopsPerReceive = 100'000;

constexpr Way back(Way out) { return out == Way::kToSlave ? Way::kToMaster : Way::kToSlave; }

constexpr Nonce nonce_of(const Header& header) {
  return {.type = static_cast<std::uint8_t>(header.type), .sequence = header.sequence};
}

static_assert(kOverheadBytes == kHeaderBytes + kTagBytes);

// What counts however old it is.
bool stops(const MotionCommand& command) { return command.request == Request::kStop; }
bool stops(const StiffnessReport& report) {
  return report.state == SafetyState::kStopped || report.state == SafetyState::kFault;
}
bool stops(const Telemetry&) { return false; }
bool stops(const BodyPoses&) { return false; }

}  // namespace

Port::Port(Channel& channel, const ImpairmentConfig& impairment, Random random, Way out)
    : channel_(channel), out_(out), impairment_(impairment, random) {}

Port::~Port() = default;

Port::Seals::Seals(const Session& session, Way way_out) : out(session, way_out), in(session, back(way_out)) {}

void Port::follow(const Session& session) {
  endpoint_.follow(session.number);
  seals_.emplace(session, out_);
  channel_.answer_to(kNowhere);
}

void Port::leave() {
  endpoint_.leave();
  seals_.reset();
  channel_.answer_to(kNowhere);
}

void Port::drain(Time now, bool stalled) {
  stalled_ = stalled || more_;
  more_ = stalled_;
  if (stalled_) endpoint_.skip_stall();
  for (int i = 0; i < kDatagramsPerReceive; ++i) {
    const auto size = channel_.receive(buffer_);
    if (!size) {
      more_ = false;
      break;
    }
    // Never one of ours: no need to carry it through the artificial network.
    if (*size > buffer_.size()) {
      count(Rejection::kLength);
      continue;
    }
    const auto datagram = std::span<const std::byte>(buffer_).first(*size);
    // What came meanwhile would leave the artificial network later, as if it were new.
    if (impairment_.clear() || stalled_) {
      impairment_.pass();
      count(judge(now, datagram, channel_.origin()));
    } else {
      impairment_.push(now, datagram, channel_.origin());
    }
  }
  // What is under way in the artificial network while this side stands still was overtaken by what lay there.
  for (int i = 0; i < kPopsPerReceive && !impairment_.clear(); ++i) {
    auto datagram = impairment_.pop(now);
    if (!datagram && stalled_) datagram = impairment_.pop(Time::max());
    if (!datagram) break;
    count(judge(now, *datagram, impairment_.origin()));
  }
}

std::uint64_t Port::rejected_total() const {
  return std::accumulate(rejected_.begin(), rejected_.end(), std::uint64_t{0});
}

void Port::count(std::optional<Rejection> rejection) {
  if (rejection) {
    ++rejected_[static_cast<std::size_t>(*rejection)];
  } else {
    ++accepted_;
  }
}

std::optional<Rejection> Port::judge(Time now, std::span<const std::byte> datagram, const Origin& origin) {
  const auto read = read_header(datagram);
  if (const auto* rejection = std::get_if<Rejection>(&read)) return *rejection;
  const Header& header = std::get<Header>(read);
  if (way_of(header.type) == out_) return Rejection::kType;
  if (const auto rejection = endpoint_.judge(header)) return rejection;
  const auto sealed = datagram.subspan(kHeaderBytes);
  if (!seals_->in.open(nonce_of(header), datagram.first(kHeaderBytes), sealed, body_))
    return Rejection::kAuthentication;

  const bool newest = endpoint_.mark(header);
  if (newest) channel_.answer_to(origin);
  return accept(now, {header, std::span<const std::byte>(body_).first(sealed.size() - kTagBytes), newest});
}

template <class Message>
std::optional<Rejection> Port::accept_into(Inbox<Received<Message>>& inbox, Time now,
                                           const Opened& datagram) {
  Stamp stamp;
  Received<Message>& received = inbox.next();
  if (const auto rejection = codec_.decode(datagram.body, stamp, received.message)) return rejection;
  if (stalled_ && !stops(received.message)) return Rejection::kStalled;
  received.rtt = kNoRtt;
  if (!stalled_)
    received.rtt = endpoint_.learn(now, datagram.header, stamp, datagram.body.size() + kOverheadBytes);
  received.sequence = datagram.header.sequence;
  received.sent = stamp.sent;
  received.received = now;
  received.echo_sent = echo_sent(now, stamp);
  received.newest = datagram.newest;
  inbox.keep();
  return std::nullopt;
}

template <class Message>
std::size_t Port::send_message(Time now, DatagramType type, std::uint64_t sequence, const Message& message,
                               ByteBudget* budget) {
  const auto header = endpoint_.number(type, sequence);
  if (!header) return 0;
  std::array<std::byte, kDatagramMaxBytes> datagram;
  const auto body = std::span(datagram).subspan(kHeaderBytes);
  const std::size_t size = codec_.encode(endpoint_.stamp_for(now), message, body.first(kBodyMaxBytes));
  write_header(*header, datagram);
  seals_->out.close(nonce_of(*header), std::span(datagram).first(kHeaderBytes), body.first(size + kTagBytes));
  channel_.send(std::span(datagram).first(size + kOverheadBytes));
  (budget != nullptr ? *budget : budget_).spend(now, size + kOverheadBytes);
  return size + kOverheadBytes;
}

void MasterPort::receive(Time now, bool stalled) {
  reports_.open();
  telemetry_.open();
  bodies_.open();
  drain(now, stalled);
  reports_.close();
  telemetry_.close();
  bodies_.close();
}

std::optional<Rejection> MasterPort::accept(Time now, const Opened& datagram) {
  if (datagram.header.type == DatagramType::kStiffnessReport) return accept_into(reports_, now, datagram);
  if (datagram.header.type == DatagramType::kBodyPoses) return accept_into(bodies_, now, datagram);
  return accept_into(telemetry_, now, datagram);
}

void MasterPort::send(Time now, std::uint64_t sequence, const MotionCommand& command) {
  send_message(now, DatagramType::kMotionCommand, sequence, command);
}

void SlavePort::receive(Time now, bool stalled) {
  commands_.open();
  drain(now, stalled);
  commands_.close();
}

std::optional<Rejection> SlavePort::accept(Time now, const Opened& datagram) {
  return accept_into(commands_, now, datagram);
}

std::size_t SlavePort::send(Time now, std::uint64_t sequence, const StiffnessReport& report) {
  return send_message(now, DatagramType::kStiffnessReport, sequence, report);
}

std::size_t SlavePort::send(Time now, std::uint64_t sequence, const Telemetry& telemetry) {
  return send_message(now, DatagramType::kTelemetry, sequence, telemetry);
}

std::size_t SlavePort::send(Time now, std::uint64_t sequence, const BodyPoses& bodies) {
  return send_message(now, DatagramType::kBodyPoses, sequence, bodies, &bodies_budget_);
}

}  // namespace longreach
