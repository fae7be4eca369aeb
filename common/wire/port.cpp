#include "common/wire/port.hpp"

#include <numeric>

namespace longreach {
namespace {

// More than the impairment can hold: a bound, not a limit that is met.
constexpr int kPopsPerReceive = 100'000;

}  // namespace

Port::Port(Channel& channel, std::uint64_t session, const ImpairmentConfig& impairment, Random random)
    : channel_(channel), endpoint_(session), impairment_(impairment, random) {}

Port::~Port() = default;

void Port::receive(Time now) {
  open_inboxes();
  for (int i = 0; i < kDatagramsPerReceive; ++i) {
    const auto size = channel_.receive(buffer_);
    if (!size) break;
    // Never one of ours: no need to carry it through the artificial network.
    if (*size > buffer_.size()) {
      count(Rejection::kLength);
      continue;
    }
    impairment_.push(now, std::span<const std::byte>(buffer_).first(*size));
  }
  for (int i = 0; i < kPopsPerReceive; ++i) {
    const auto datagram = impairment_.pop(now);
    if (!datagram) break;
    count(judge(now, *datagram));
  }
  close_inboxes();
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

std::optional<Rejection> Port::judge(Time now, std::span<const std::byte> datagram) {
  const auto read = read_header(datagram);
  if (const auto* rejection = std::get_if<Rejection>(&read)) {
    // The type is checked before the checksum, and only this side knows which types it takes.
    const bool foreign = *rejection == Rejection::kChecksum &&
                         !takes(DatagramType{std::to_integer<std::uint8_t>(datagram[1])});
    return foreign ? Rejection::kType : *rejection;
  }
  const Header& header = std::get<Header>(read);
  if (!takes(header.type)) return Rejection::kType;
  if (const auto rejection = endpoint_.judge(now, header)) return rejection;
  return accept(now, header, datagram.subspan(kHeaderBytes), datagram.size());
}

template <class Message>
std::optional<Rejection> Port::accept_into(Inbox<Received<Message>>& inbox, Time now, const Header& header,
                                           std::span<const std::byte> body, std::size_t bytes) {
  const auto decoded = codec_.decode<Message>(body);
  if (const auto* rejection = std::get_if<Rejection>(&decoded)) return *rejection;
  const auto& [stamp, message] = std::get<Decoded<Message>>(decoded);
  const auto committed = endpoint_.commit(now, header, stamp, bytes);
  if (const auto* rejection = std::get_if<Rejection>(&committed)) return *rejection;
  const auto& accepted = std::get<Endpoint::Accepted>(committed);
  inbox.push({header.sequence, stamp.sent, now, accepted.echo_sent, accepted.newest, message});
  return std::nullopt;
}

template <class Message>
std::size_t Port::send_message(Time now, DatagramType type, std::uint64_t sequence, const Message& message) {
  std::array<std::byte, kDatagramMaxBytes> datagram;
  const auto body = std::span(datagram).subspan(kHeaderBytes);
  const std::size_t size = kHeaderBytes + codec_.encode(endpoint_.stamp_for(now), message, body);
  const auto bytes = std::span(datagram).first(size);
  write_header(endpoint_.header_for(type, sequence), bytes);
  channel_.send(bytes);
  return size;
}

bool MasterPort::takes(DatagramType type) const {
  return type == DatagramType::kStiffnessReport || type == DatagramType::kTelemetry;
}

std::optional<Rejection> MasterPort::accept(Time now, const Header& header, std::span<const std::byte> body,
                                            std::size_t bytes) {
  return header.type == DatagramType::kStiffnessReport ? accept_into(reports_, now, header, body, bytes)
                                                       : accept_into(telemetry_, now, header, body, bytes);
}

void MasterPort::open_inboxes() {
  reports_.open();
  telemetry_.open();
}

void MasterPort::close_inboxes() {
  reports_.close();
  telemetry_.close();
}

void MasterPort::send(Time now, std::uint64_t sequence, const MotionCommand& command) {
  send_message(now, DatagramType::kMotionCommand, sequence, command);
}

bool SlavePort::takes(DatagramType type) const { return type == DatagramType::kMotionCommand; }

std::optional<Rejection> SlavePort::accept(Time now, const Header& header, std::span<const std::byte> body,
                                           std::size_t bytes) {
  return accept_into(commands_, now, header, body, bytes);
}

void SlavePort::open_inboxes() { commands_.open(); }

void SlavePort::close_inboxes() { commands_.close(); }

std::size_t SlavePort::send(Time now, std::uint64_t sequence, const StiffnessReport& report) {
  return send_message(now, DatagramType::kStiffnessReport, sequence, report);
}

void SlavePort::send(Time now, std::uint64_t sequence, const Telemetry& telemetry) {
  send_message(now, DatagramType::kTelemetry, sequence, telemetry);
}

}  // namespace longreach
