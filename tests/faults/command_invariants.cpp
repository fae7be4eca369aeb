// I13 to I20, I26: what was sent, what was taken, what was changed, and how much of it.

#include <algorithm>

#include "common/wire/port.hpp"
#include "tests/faults/invariant.hpp"

namespace longreach {
namespace {

class Authentic : public Invariant {
 public:
  explicit Authentic(const Scenario&)
      : Invariant("I13-15",
                  "a command that is taken is one that the lease's master sent, in this session, in order") {}
  void see(const Moment& m) override {
    if (m.slave_ran) that(m, !m.given_badly, "the slave took a command that nobody sent so");
  }
};

/// While it is engaged, what it follows is no older than the least since the engagement and a documented
/// excess. By means, since a single datagram may be let past; the link's own jitter adds to it.
class Fresh : public Invariant {
 public:
  explicit Fresh(const Scenario& s)
      : Invariant("I16", "what is followed is fresh"),
        rise_s_(1.0 + 2.0 * (s.master.link.impairment.jitter_s + s.slave.link.impairment.jitter_s)) {}
  void see(const Moment& m) override {
    const MotionAuthority& authority = m.sent_log->authority();
    if (!m.slave_ran || m.claimed != SafetyState::kEngaged || authority.newest == nullptr) {
      least_s_ = 1e9;
      return;
    }
    const double age_s = m.t_s - authority.sent_s;
    if (m.engagement != engagement_) {
      least_s_ = 1e9;
      mean_s_ = age_s;
      known_s_ = 0.0;
    }
    engagement_ = m.engagement;
    known_s_ += m.slave_gap_s;
    mean_s_ += std::min(1.0, m.slave_gap_s / kMean_s) * (age_s - mean_s_);
    old_s_ = age_s > least_s_ + rise_s_ ? old_s_ + m.slave_gap_s : 0.0;
    least_s_ += kDrift * m.slave_gap_s;
    if (known_s_ > kMean_s) least_s_ = std::min(least_s_, mean_s_);
    at_most(m, old_s_, kLong_s, "s long engaged by commands that are too old");
  }

 private:
  static constexpr double kLong_s = 0.8, kDrift = 1e-3, kMean_s = 0.25;
  double rise_s_;
  std::uint32_t engagement_ = 0;
  double least_s_ = 1e9, mean_s_ = 0.0, known_s_ = 0.0, old_s_ = 0.0;
};

class Nonces : public Invariant {
 public:
  explicit Nonces(const Scenario&) : Invariant("I19", "no number leaves twice under one key") {}
  void see(const Moment& m) override {
    if (m.datagrams > 0) that(m, !m.number_again, "a number has left before in this session");
  }
};

class Limits : public Invariant {
 public:
  explicit Limits(const Scenario&)
      : Invariant("I20", "no limit is less restrictive than the file's, whatever clients ask for") {}
  void see(const Moment& m) override {
    if (m.configured) that(m, m.loosened.empty(), m.loosened.c_str());
  }
};

/// What a side does in a tick, however much there is to do: what a node is given of a type, what leaves.
class Bounded : public Invariant {
 public:
  explicit Bounded(const Scenario&) : Invariant("I26", "the work of a tick is bounded") {}
  void see(const Moment& m) override {
    at_most(m, static_cast<double>(m.given), static_cast<double>(kInboxCapacity), "commands in a tick");
    at_most(m, static_cast<double>(m.datagrams), kLeave, "datagrams that left in a tick");
  }

 private:
  static constexpr double kLeave = 3.0;  // a command, a report, telemetry
};

}  // namespace

void add_command_invariants(const Scenario& s, Invariants& all) {
  all.push_back(std::make_unique<Authentic>(s));
  all.push_back(std::make_unique<Fresh>(s));
  all.push_back(std::make_unique<Nonces>(s));
  all.push_back(std::make_unique<Limits>(s));
  all.push_back(std::make_unique<Bounded>(s));
}

}  // namespace longreach
