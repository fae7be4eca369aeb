#include "deploy/library/include/longreach/link.hpp"

#include <array>
#include <cmath>
#include <cstring>

#include "common/config/config.hpp"
#include "common/link/impairment.hpp"
#include "deploy/library/files.hpp"

namespace longreach {
namespace {

proto::LinkProfile read(const std::string& profile) {
  return with_input_errors([&] {
    proto::LinkProfile read = load_link_profile(library_search(), profile);
    validate(read);
    return read;
  });
}

LinkConditions conditions_of(const ImpairmentConfig& c) {
  return {.delay_s = c.delay_s,
          .jitter_s = c.jitter_s,
          .loss = c.loss,
          .loss_burst = c.loss_burst,
          .duplicate = c.duplicate,
          .reorder = c.reorder,
          .corrupt = c.corrupt,
          .rate_bit_per_s = c.rate_bit_per_s,
          .blackout_start_s = c.blackout_start_s,
          .blackout_duration_s = c.blackout_duration_s};
}

ImpairmentConfig config_of(const LinkConditions& c) {
  ImpairmentConfig config;
  config.delay_s = c.delay_s;
  config.jitter_s = c.jitter_s;
  config.loss = c.loss;
  config.loss_burst = c.loss_burst;
  config.duplicate = c.duplicate;
  config.reorder = c.reorder;
  config.corrupt = c.corrupt;
  config.rate_bit_per_s = c.rate_bit_per_s;
  config.blackout_start_s = c.blackout_start_s;
  config.blackout_duration_s = c.blackout_duration_s;
  with_input_errors([&] { validate(to_message(config)); });
  return config;
}

std::size_t index(LinkEnd end) { return end == LinkEnd::kSlave ? 0 : 1; }

Time time_of(double now_s) {
  require_range("now_s", now_s, 0.0, 1e9);
  return Time{from_seconds(now_s)};
}

}  // namespace

LinkPair link_conditions(const std::string& profile) {
  const proto::LinkProfile p = read(profile);
  return {.up = conditions_of(to_struct(p.up())), .down = conditions_of(to_struct(p.down()))};
}

// The direction towards an end, by its index.
struct SimulatedLink::State {
  State(const ImpairmentConfig& up, const ImpairmentConfig& down, std::uint64_t seed)
      : towards{Impairment(up, Random(seed).child("up")), Impairment(down, Random(seed).child("down"))} {}
  std::array<Impairment, 2> towards;
};

SimulatedLink::SimulatedLink(const LinkPair& conditions, std::uint64_t seed)
    : state_(std::make_unique<State>(config_of(conditions.up), config_of(conditions.down), seed)) {}

SimulatedLink::SimulatedLink(const std::string& profile, std::uint64_t seed) {
  const proto::LinkProfile p = read(profile);
  state_ = std::make_unique<State>(to_struct(p.up()), to_struct(p.down()), seed);
}

SimulatedLink::~SimulatedLink() = default;
SimulatedLink::SimulatedLink(SimulatedLink&&) noexcept = default;
SimulatedLink& SimulatedLink::operator=(SimulatedLink&&) noexcept = default;

void SimulatedLink::send(LinkEnd from, double now_s, std::span<const std::byte> datagram) {
  if (datagram.size() > kDatagramMax)
    throw InputError("the datagram has " + std::to_string(datagram.size()) + " bytes; " +
                     std::to_string(kDatagramMax) + " are allowed");
  state_->towards[1 - index(from)].push(time_of(now_s), datagram);
}

std::optional<std::vector<std::byte>> SimulatedLink::receive(LinkEnd at, double now_s) {
  const auto due = state_->towards[index(at)].pop(time_of(now_s));
  if (!due) return std::nullopt;
  return std::vector<std::byte>(due->begin(), due->end());
}

LinkCounts SimulatedLink::counts(LinkEnd at) const {
  const ImpairmentCounts& c = state_->towards[index(at)].counts();
  return {.sent = c.in,
          .delivered = c.out,
          .lost = c.lost + c.blacked_out + c.queue_dropped,
          .duplicated = c.duplicated,
          .reordered = c.reordered,
          .corrupted = c.corrupted};
}

}  // namespace longreach
