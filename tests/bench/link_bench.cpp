// What a datagram costs on its way between a node and a channel. Argument: cipher, 0 ChaCha20-Poly1305, 1
// AES-256-GCM (where the processor has it).

#include <benchmark/benchmark.h>

#include <utility>

#include "common/wire/port.hpp"
#include "tests/unit/common/wire/samples.hpp"

namespace longreach {
namespace {

/// The last datagram, as often as it is asked for.
class Echoing : public Channel {
 public:
  std::optional<std::size_t> receive(std::span<std::byte> buffer) override {
    if (size_ == 0) return std::nullopt;
    std::copy_n(bytes_.begin(), size_, buffer.begin());
    return std::exchange(size_, 0);
  }
  void send(std::span<const std::byte> datagram) override {
    size_ = datagram.size();
    std::copy_n(datagram.begin(), size_, bytes_.begin());
  }

 private:
  std::array<std::byte, kDatagramMaxBytes> bytes_{};
  std::size_t size_ = 0;
};

Session session_of(benchmark::State& state) {
  const auto cipher = static_cast<Cipher>(state.range(0));
  if (cipher == Cipher::kAes256Gcm && !has_aes256gcm()) {
    state.SkipWithError("no AES-256-GCM on this processor");
    return samples::session();
  }
  return samples::session(1000, cipher);
}

template <class Message>
void seal_and_open(benchmark::State& state, const Message& message, bool open) {
  const Seal seal(session_of(state), Way::kToSlave);
  const std::string body = samples::body_of(message);
  std::vector<std::byte> datagram(body.size() + kOverheadBytes);
  std::vector<std::byte> opened(body.size());
  const auto header = std::span(datagram).first(kHeaderBytes);
  const auto sealed = std::span(datagram).subspan(kHeaderBytes);
  Nonce nonce{1, 1};
  seal.close(nonce, header, sealed);
  for (auto _ : state) {
    if (open) {
      benchmark::DoNotOptimize(seal.open(nonce, header, sealed, opened));
    } else {
      ++nonce.sequence;
      seal.close(nonce, header, sealed);
    }
    benchmark::ClobberMemory();
  }
  state.counters["bytes"] = static_cast<double>(datagram.size());
}

void close_command(benchmark::State& state) { seal_and_open(state, samples::command(), false); }
void open_command(benchmark::State& state) { seal_and_open(state, samples::command(), true); }
void close_telemetry(benchmark::State& state) { seal_and_open(state, samples::telemetry(), false); }
void open_telemetry(benchmark::State& state) { seal_and_open(state, samples::telemetry(), true); }

/// The codec alone: what the seal comes on top of.
void encode_command(benchmark::State& state) {
  Codec codec;
  std::array<std::byte, kBodyMaxBytes> body;
  for (auto _ : state) benchmark::DoNotOptimize(codec.encode(samples::stamp(), samples::command(), body));
}
void decode_command(benchmark::State& state) {
  Codec codec;
  const std::string body = samples::body_of(samples::command());
  Stamp stamp;
  MotionCommand command;
  for (auto _ : state) benchmark::DoNotOptimize(codec.decode(std::as_bytes(std::span(body)), stamp, command));
}

/// A command from node to channel: number, stamp, codec, seal.
void send_command(benchmark::State& state) {
  Echoing channel;
  MasterPort master(channel, ImpairmentConfig{}, Random(1));
  master.follow(session_of(state));
  const MotionCommand command = samples::command();
  std::uint64_t sequence = 0;
  for (auto _ : state) master.send(Time{Duration{1}}, ++sequence, command);
}

/// The same, and from the channel to the other node: all checks, impairment, delay monitor.
void exchange_command(benchmark::State& state) {
  Echoing channel;
  MasterPort master(channel, ImpairmentConfig{}, Random(1));
  SlavePort slave(channel, ImpairmentConfig{}, Random(2));
  master.follow(session_of(state));
  slave.follow(session_of(state));
  const MotionCommand command = samples::command();
  std::uint64_t sequence = 0;
  for (auto _ : state) {
    const Time now{std::chrono::milliseconds(++sequence)};
    master.send(now, sequence, command);
    slave.receive(now);
  }
  if (slave.accepted_total() != sequence) state.SkipWithError("not every datagram was accepted");
}

/// A forged datagram costs the slave this much.
void refuse_forged(benchmark::State& state) {
  Echoing channel;
  SlavePort slave(channel, ImpairmentConfig{}, Random(2));
  slave.follow(session_of(state));
  auto forged = samples::datagram(samples::command(), 1);
  forged.back() ^= std::byte{1};
  for (auto _ : state) {
    channel.send(forged);
    slave.receive(Time{Duration{1}});
  }
}

BENCHMARK(encode_command);
BENCHMARK(decode_command);
BENCHMARK(close_command)->Arg(0)->Arg(1);
BENCHMARK(open_command)->Arg(0)->Arg(1);
BENCHMARK(close_telemetry)->Arg(0)->Arg(1);
BENCHMARK(open_telemetry)->Arg(0)->Arg(1);
BENCHMARK(send_command)->Arg(0)->Arg(1);
BENCHMARK(exchange_command)->Arg(0)->Arg(1);
BENCHMARK(refuse_forged)->Arg(0)->Arg(1);

}  // namespace
}  // namespace longreach
