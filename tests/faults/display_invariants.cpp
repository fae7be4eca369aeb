// I25, I27, I38: what the operator is shown was true when it left, and everything that came is accounted for.

#include <algorithm>
#include <deque>
#include <utility>

#include "tests/faults/invariant.hpp"

namespace longreach {
namespace {

class TruePicture : public Invariant {
 public:
  explicit TruePicture(const Scenario&)
      : Invariant("I25", "what the operator sees was true of the robot one delay ago") {}
  void see(const Moment& m) override {
    if (m.telemetry) {
      // While the robot says that it has failed, its pose is the last that was believed.
      if (m.reported.ok && m.since(AffectedSignal::kJoints) > 0.1 && m.claimed != SafetyState::kFault)
        at_most(m, (m.telemetry->X_WE.p - m.X_WE.p).norm(), 1e-6, "m between what is told and what is");
      that(m, m.telemetry->state == m.claimed || m.since(AffectedSignal::kSlave) < 0.1,
           "the picture shows another state than the report");
      sent_.push_back(m.telemetry->X_WE.p);
      if (sent_.size() > kKept) sent_.pop_front();
    }
    if (m.seen) that(m, was_sent(m.seen->X_WE.p), "the operator sees what no slave sent");
  }

 private:
  static constexpr std::size_t kKept = 4096;
  [[nodiscard]] bool was_sent(const Vector3& p) const {
    for (auto at = sent_.rbegin(); at != sent_.rend(); ++at)
      if (*at == p) return true;
    return false;
  }
  std::deque<Vector3> sent_;
};

/// The late ticks of the slave and the loss of commands, from what the slave was given.
class TrueFigures : public Invariant {
 public:
  explicit TrueFigures(const Scenario&)
      : Invariant("I38", "the operator sees how many ticks of the slave were late and how much was lost") {}
  void see(const Moment& m) override {
    if (!m.slave_ran) return;
    if (m.slave_gap_s > kLate_s + 1.5 * m.period_s) ++late_;
    for (const std::uint64_t number : m.given_numbers) {
      if (number < newest_) overtaken_s_ = m.t_s;
      newest_ = number;
      given_.emplace_back(m.t_s, number);
    }
    while (!given_.empty() && given_.front().first < m.t_s - kWindow_s) given_.pop_front();
    // Of datagrams that overtake each other it is known only later which are lost.
    const bool stable = m.since(AffectedSignal::kSlave) > kStable_s &&
                        m.since(AffectedSignal::kLease) > kStable_s && m.t_s - overtaken_s_ > kStable_s;
    if (!(stable && lost() > kMuch)) lost_much_s_ = m.t_s;
    if (!m.telemetry) return;
    that(m, m.telemetry->late_ticks == late_, "another number of late ticks is shown");
    that(m, m.t_s - lost_much_s_ < kLasts_s || m.telemetry->up_loss > kLittle,
         "much of the commands was lost, and that is not shown");
  }

 private:
  static constexpr double kLate_s = 0.1, kWindow_s = 1.0, kStable_s = 4.0, kLasts_s = 1.2, kMuch = 0.15,
                          kLittle = 0.03;
  static constexpr std::size_t kEnough = 30;
  /// Share of the numbers that are missing in the last second.
  [[nodiscard]] double lost() const {
    if (given_.size() < kEnough) return 0.0;
    const auto [least, most] = std::ranges::minmax(given_, {}, &std::pair<double, std::uint64_t>::second);
    return 1.0 - static_cast<double>(given_.size()) / static_cast<double>(most.second - least.second + 1);
  }
  std::uint64_t late_ = 0;
  std::uint64_t newest_ = 0;
  double overtaken_s_ = 0.0;
  double lost_much_s_ = 0.0;  // time at which less was lost
  std::deque<std::pair<double, std::uint64_t>> given_;
};

class Conserved : public Invariant {
 public:
  explicit Conserved(const Scenario&) : Invariant("I27", "received is accepted and rejected by reason") {}
  void see(const Moment& m) override {
    that(m, m.received == m.accounted, "datagrams are missing in the counts");
  }
};

}  // namespace

void add_display_invariants(const Scenario& s, Invariants& all) {
  all.push_back(std::make_unique<TruePicture>(s));
  all.push_back(std::make_unique<TrueFigures>(s));
  all.push_back(std::make_unique<Conserved>(s));
}

}  // namespace longreach
