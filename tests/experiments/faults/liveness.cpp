// L1 to L3: once nothing goes wrong any more, it works again when it is asked to.

#include <algorithm>

#include "tests/experiments/faults/invariant.hpp"

namespace longreach {
namespace {

/// Seconds since the faults ended.
class Calm {
 public:
  double since(const Moment& m) {
    if (!m.faults_over) over_s_ = m.t_s;
    return m.t_s - over_s_;
  }

 private:
  double over_s_ = 0.0;
};

class Hears : public Invariant {
 public:
  explicit Hears(const Scenario& s)
      : Invariant("L1", "both sides hear each other again"), bound_s_(s.round_trip_s + 1.5) {}
  void see(const Moment& m) override {
    if (calm_.since(m) < bound_s_) return;
    that(m, m.shown != SafetyState::kIdle && m.claimed != SafetyState::kIdle,
         "a side is idle though both run");
  }

 private:
  Calm calm_;
  double bound_s_;
};

class Engages : public Invariant {
 public:
  explicit Engages(const Scenario& s)
      : Invariant("L2", "an engagement that is asked for comes about"), round_trip_s_(s.round_trip_s) {}
  void see(const Moment& m) override {
    const bool calm = calm_.since(m) > kSettles_s + round_trip_s_;
    if (m.shown == SafetyState::kEngaged) {
      if (asked_s_ > 0.0) at_most(m, m.t_s - asked_s_, bound_s(), "s from asking to being engaged");
      asked_s_ = 0.0;
    } else if (calm && m.engage_asked && asked_s_ == 0.0) {
      asked_s_ = m.t_s;
    }
    if (asked_s_ > 0.0) at_most(m, m.t_s - asked_s_, bound_s(), "s after asking not engaged");
  }

 private:
  static constexpr double kSettles_s = 3.0;
  [[nodiscard]] double bound_s() const { return round_trip_s_ + 0.5 + 0.005; }
  Calm calm_;
  double round_trip_s_;
  double asked_s_ = 0.0;
};

}  // namespace

void add_liveness(const Scenario& s, Invariants& all) {
  all.push_back(std::make_unique<Hears>(s));
  all.push_back(std::make_unique<Engages>(s));
}

}  // namespace longreach
