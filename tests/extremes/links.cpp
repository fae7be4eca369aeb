// The link: delays, clocks and numbers at their ends. Two ports with real bytes between them.

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "common/config/config.hpp"
#include "common/text/number_text.hpp"
#include "common/wire/memory_channel.hpp"
#include "common/wire/port.hpp"
#include "deploy/lab/experiment.hpp"
#include "tests/extremes/extremes.hpp"

namespace longreach {
namespace {

constexpr double kPeriod_s = 1e-3;  // of both sides' turns
constexpr int kSend = 20;           // turns
constexpr double kYear_s = 365.25 * 86400.0;
// A datagram lies in the channel, and then waits, for the next turn, each way.
constexpr double kTurns_s = 4.0 * kPeriod_s + 1e-9;

struct Talk {
  double delay_s = 0.1;                      // each way
  double master_s = 100.0, slave_s = 777.0;  // clocks at the start
  std::uint64_t first = 1;                   // number of the first datagram
  double reported_s = 0.0;                   // less than the link has each way, in the control
  bool count = false;                        // the result: datagrams that got lost, not the round trip
};

/// Both talk until echoes have come; the round trip that the master measures.
ExtremeResult talk(const Talk& what, std::uint64_t seed) {
  MemoryChannelPair channels;
  const ImpairmentConfig link{.delay_s = what.delay_s};
  const Random random = Random(seed).child("extremes link");
  MasterPort master(channels.a(), link, random.child("down"));
  SlavePort slave(channels.b(), link, random.child("up"));
  const Session session{.number = 1};
  master.follow(session);
  slave.follow(session);
  const Time master_start = Time{} + from_seconds(what.master_s),
             slave_start = Time{} + from_seconds(what.slave_s);
  std::uint64_t number = what.first;
  const double end_s = 2.0 * what.delay_s + 5.0;
  Time now = master_start;
  const auto turns = static_cast<int>(end_s / kPeriod_s);
  std::uint64_t due = 0;  // of the datagrams of both: those that have had the time to come
  for (int i = 0; i < turns; ++i) {
    const Duration elapsed = from_seconds(kPeriod_s * i);
    now = master_start + elapsed;
    slave.receive(slave_start + elapsed);
    master.receive(now);
    if (i % kSend != 0) continue;
    slave.send(slave_start + elapsed, number, StiffnessReport{});
    master.send(now, number, MotionCommand{});
    if (kPeriod_s * (turns - i) > what.delay_s + kTurns_s) due += 2;
    if (number < UINT64_MAX) ++number;
  }
  const auto rejected = master.rejected();
  for (std::size_t i = 0; i < kRejectionCount; ++i) {
    if (rejected[i] > 0) return refused("rejected: " + std::string(to_string(static_cast<Rejection>(i))));
  }
  const LinkFigures figures = master.endpoint().monitor().figures(now);
  const std::uint64_t taken = master.accepted_total() + slave.accepted_total();
  if (what.first == UINT64_MAX)
    return taken == 0 ? refused("nothing leaves: the numbers are at their end")
                      : bad("the last number leaves");
  if (!figures.rtt_s) return bad("no round trip is seen");
  const std::uint64_t lost = due - std::min(due, taken);
  if (what.first == 0 && lost == 2)
    return refused("zero is no number: no datagram goes with it, the next ones do");
  if (what.count) return accurate(static_cast<double>(lost), 0.0);
  const double late_s = *figures.rtt_s - 2.0 * (what.delay_s - what.reported_s);
  return late_s > -1e-9 ? accurate(std::max(0.0, late_s), kTurns_s) : bad("faster than the link");
}

/// Takes every number once, whatever has come: what the control puts in the place of the window.
struct Forgetful {
  std::uint64_t newest = 0;
  bool accept(std::uint64_t number) { return newest = number, number > 0; }
};

/// Every number from `number` downwards, twice in random order: verdicts that a list of all of them has not.
template <class Window>
ExtremeResult once(std::uint64_t number, std::uint64_t seed) {
  constexpr std::uint64_t kMany = 100;  // less than the window is wide
  if (number == 0) return Window().accept(number) ? bad("zero is taken") : refused("zero is no number");
  Random random = Random(seed).child("extremes replays");
  Window window;
  std::set<std::uint64_t> known;
  int wrong = 0;
  for (int i = 0; i < 400; ++i) {
    const std::uint64_t one = number - std::min(number - 1, random.next() % kMany);
    if (window.accept(one) != known.insert(one).second) ++wrong;
  }
  return accurate(wrong / 400.0, 0.0);
}

std::string power(std::uint64_t number) {
  if (number == UINT64_MAX) return "2^64-1";
  if (number == UINT64_MAX - 1) return "2^64-2";
  return number == (1ULL << 32) ? "2^32" : number == (1ULL << 63) ? "2^63" : std::to_string(number);
}

}  // namespace

std::vector<ExtremeRow> extreme_links() {
  const auto cell = [](const std::string& name, const Talk& what, const std::string& refusal = "") {
    return ExtremeCell{name, refusal, [what](std::uint64_t seed) { return talk(what, seed); }};
  };
  const ExtremeCell longer = cell("10 ms longer than told", Talk{.reported_s = 0.01});
  ExtremeRow delays{"link: delay each way", "round trip too long, s", longer, {}};
  for (const double delay_s : {0.0, 1e-3, 1.0, 10.0, 100.0})
    delays.cells.push_back(cell(short_text(delay_s) + " s", {.delay_s = delay_s}));
  delays.cells.push_back({"101 s", "outside 0 to 100", [](std::uint64_t seed) {
                            static_cast<void>(
                                configure({"slave.link.impairment.delay_s=101"}, find_deploy_folder()));
                            return talk({.delay_s = 101.0}, seed);
                          }});
  ExtremeRow clocks{"link: both clocks after", "round trip too long, s", longer, {}};
  for (const double years : {0.0, 10.0, 126.0, 130.0})
    clocks.cells.push_back(cell(short_text(years) + " years",
                                {.master_s = years * kYear_s, .slave_s = years * kYear_s},
                                years > 127.0 ? "rejected: value" : ""));
  clocks.cells.push_back(cell("0 and 10", {.master_s = 0.0, .slave_s = 10.0 * kYear_s}));
  clocks.cells.push_back(cell("-10 and 10", {.master_s = -10.0 * kYear_s, .slave_s = 10.0 * kYear_s}));
  ExtremeRow numbers{"link: first number of a datagram",
                     "datagrams that got lost",
                     cell("the last but 99", {.first = UINT64_MAX - 99, .count = true}),
                     {}};
  for (const std::uint64_t first :
       {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 32, std::uint64_t{1} << 63, UINT64_MAX})
    numbers.cells.push_back(cell(power(first), {.first = first, .count = true},
                                 first == 0            ? "zero is no number"
                                 : first == UINT64_MAX ? "the numbers are at their end"
                                                       : ""));
  ExtremeRow replays{"link: number in the replay window", "share of wrong verdicts", {}, {}};
  for (const std::uint64_t number : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 32,
                                     std::uint64_t{1} << 63, UINT64_MAX - 1, UINT64_MAX})
    replays.cells.push_back({power(number), number == 0 ? "zero is no number" : "",
                             [number](std::uint64_t seed) { return once<ReplayWindow>(number, seed); }});
  replays.control = {"no window", "", [](std::uint64_t seed) { return once<Forgetful>(1000, seed); }};
  return {delays, clocks, numbers, replays};
}

}  // namespace longreach
