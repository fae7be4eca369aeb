// What the link adds to the round trip of a datagram: a command from the master's port to the slave's and a
// report back, over UDP sockets on loopback, against bare sockets that carry as many bytes. Both ends wait by
// polling, in one thread. Both take turns in short blocks, so that a machine that is now slow, now quick is
// so to both; the figures are medians of the blocks. Bare sockets are not connected, since a slave's cannot
// be: it does not know its master before. First argument: 0 ChaCha20-Poly1305, 1 AES-256-GCM. Second: 0 bare
// sockets read once, 1 until nothing is left, as who wants the newest must.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <asio/ip/udp.hpp>
#include <chrono>
#include <vector>

#include "common/net/udp_channel.hpp"
#include "common/wire/port.hpp"
#include "tests/unit/common/wire/samples.hpp"

namespace longreach {
namespace {

class BareSockets {
 public:
  explicit BareSockets(bool drained) : drained_(drained) {
    for (udp::socket* socket : {&a_, &b_}) socket->non_blocking(true);
  }
  void round_trip() {
    pass(a_, b_, at_b_, command_bytes_);
    pass(b_, a_, at_a_, report_bytes_);
  }

 private:
  using udp = asio::ip::udp;

  void pass(udp::socket& from, udp::socket& to, const udp::endpoint& at_to, std::size_t size) {
    from.send_to(asio::buffer(buffer_.data(), size), at_to);
    while (!take(to)) continue;
    while (drained_ && take(to)) continue;
  }
  bool take(udp::socket& to) {
    udp::endpoint sender;
    asio::error_code error;
    return to.receive_from(asio::buffer(buffer_), sender, 0, error) != 0;
  }

  template <class Message>
  static std::size_t bytes_of(const Message& message) {
    return samples::body_of(message).size() + kOverheadBytes;
  }

  const std::size_t command_bytes_ = bytes_of(samples::command()),
                    report_bytes_ = bytes_of(samples::report());
  bool drained_;
  asio::io_context context_{1};
  udp::socket a_{context_, {asio::ip::address_v4::loopback(), 0}},
      b_{context_, {asio::ip::address_v4::loopback(), 0}};
  const udp::endpoint at_a_ = a_.local_endpoint(), at_b_ = b_.local_endpoint();
  std::array<std::byte, kDatagramMaxBytes> buffer_{};
};

class Ports {
 public:
  explicit Ports(Cipher cipher) {
    const Session session = samples::session(1000, cipher);
    master_.follow(session);
    slave_.follow(session);
  }
  void round_trip() {
    const Time now{std::chrono::milliseconds(++sequence_)};
    master_.send(now, sequence_, command_);
    do slave_.receive(now);
    while (slave_.commands().empty());
    slave_.send(now, sequence_, report_);
    do master_.receive(now);
    while (master_.reports().empty());
  }
  [[nodiscard]] bool lost_nothing() const { return master_.accepted_total() == sequence_; }

 private:
  UdpChannel at_slave_{"127.0.0.1:0"};
  UdpChannel at_master_{"127.0.0.1:0", at_slave_.local_address()};
  MasterPort master_{at_master_, ImpairmentConfig{}, Random(1)};
  SlavePort slave_{at_slave_, ImpairmentConfig{}, Random(2)};
  const MotionCommand command_ = samples::command();
  const StiffnessReport report_ = samples::report();
  std::uint64_t sequence_ = 0;
};

/// Microseconds a round trip.
template <class Link>
double timed(Link& link) {
  constexpr int kBlock = 50;
  const auto began = std::chrono::steady_clock::now();
  for (int i = 0; i < kBlock; ++i) link.round_trip();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - began).count() / kBlock;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void round_trip(benchmark::State& state) {
  const auto cipher = state.range(0) != 0 ? Cipher::kAes256Gcm : Cipher::kChaCha20Poly1305;
  if (cipher == Cipher::kAes256Gcm && !has_aes256gcm())
    return state.SkipWithError("this processor has no AES-GCM");
  BareSockets bare(state.range(1) != 0);
  Ports ports(cipher);
  std::vector<double> bare_us, ports_us, added_us, added_percent;
  for (auto _ : state) {
    bare_us.push_back(timed(bare));
    ports_us.push_back(timed(ports));
    added_us.push_back(ports_us.back() - bare_us.back());
    added_percent.push_back(100.0 * added_us.back() / bare_us.back());
  }
  state.counters["bare_us"] = median(bare_us);
  state.counters["ports_us"] = median(ports_us);
  state.counters["added_us"] = median(added_us);
  state.counters["added_percent"] = median(added_percent);
  if (!ports.lost_nothing()) state.SkipWithError("not every report was accepted");
}

BENCHMARK(round_trip)->ArgsProduct({{0, 1}, {0, 1}});

}  // namespace
}  // namespace longreach
