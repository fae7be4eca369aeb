// What the link adds to the round trip of a datagram: a command from the master's port to the slave's and a
// report back, over UDP sockets on loopback, against bare sockets that carry as many bytes. Both ends wait by
// polling, in one thread. Argument of `bare`: 0 not connected, since a slave's cannot be: it does not know
// its master before; 1 connected, which spares the kernel the route; 2 like 0, and read until nothing is
// left, as who wants the newest must. Argument of `ports`: 0 ChaCha20-Poly1305, 1 AES-256-GCM.

#include <benchmark/benchmark.h>

#include <asio/ip/udp.hpp>

#include "common/io/udp_channel.hpp"
#include "common/wire/port.hpp"
#include "tests/unit/wire/samples.hpp"

namespace longreach {
namespace {

constexpr std::size_t kCommandBytes = 95, kReportBytes = 200;

void bare(benchmark::State& state) {
  using asio::ip::udp;
  asio::io_context context;
  udp::socket a(context, {asio::ip::address_v4::loopback(), 0}),
      b(context, {asio::ip::address_v4::loopback(), 0});
  const bool connected = state.range(0) == 1, drained = state.range(0) == 2;
  if (connected) {
    a.connect(b.local_endpoint());
    b.connect(a.local_endpoint());
  }
  a.non_blocking(true);
  b.non_blocking(true);
  std::array<std::byte, kDatagramMaxBytes> buffer{};
  asio::error_code error;
  const udp::endpoint at_a = a.local_endpoint(), at_b = b.local_endpoint();
  const auto to_of = [&](const udp::socket& from) { return &from == &a ? at_b : at_a; };
  const auto pass = [&](udp::socket& from, udp::socket& to, std::size_t size) {
    udp::endpoint sender;
    if (connected) {
      from.send(asio::buffer(buffer.data(), size));
      while (to.receive(asio::buffer(buffer), 0, error) == 0) continue;
    } else {
      from.send_to(asio::buffer(buffer.data(), size), to_of(from));
      while (to.receive_from(asio::buffer(buffer), sender, 0, error) == 0) continue;
      while (drained && to.receive_from(asio::buffer(buffer), sender, 0, error) != 0) continue;
    }
  };
  for (auto _ : state) {
    pass(a, b, kCommandBytes);
    pass(b, a, kReportBytes);
  }
}

void ports(benchmark::State& state) {
  if (state.range(0) != 0 && !has_aes256gcm()) return state.SkipWithError("this processor has no AES-GCM");
  const Session session =
      samples::session(1000, state.range(0) != 0 ? Cipher::kAes256Gcm : Cipher::kChaCha20Poly1305);
  UdpChannel at_slave("127.0.0.1:0");
  UdpChannel at_master("127.0.0.1:0", at_slave.local_address());
  MasterPort master(at_master, ImpairmentConfig{}, Random(1));
  SlavePort slave(at_slave, ImpairmentConfig{}, Random(2));
  master.follow(session);
  slave.follow(session);
  const MotionCommand command = samples::command();
  const StiffnessReport report = samples::report();
  std::uint64_t sequence = 0;
  for (auto _ : state) {
    const Time now{std::chrono::milliseconds(++sequence)};
    master.send(now, sequence, command);
    do slave.receive(now);
    while (slave.commands().empty());
    slave.send(now, sequence, report);
    do master.receive(now);
    while (master.reports().empty());
  }
  if (master.accepted_total() != sequence) state.SkipWithError("not every report was accepted");
}

BENCHMARK(bare)->DenseRange(0, 2);
BENCHMARK(ports)->Arg(0)->Arg(1);

}  // namespace
}  // namespace longreach
