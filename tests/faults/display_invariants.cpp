// I25, I27: what the operator is shown was true when it left, and everything that came is accounted for.

#include <deque>

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
  all.push_back(std::make_unique<Conserved>(s));
}

}  // namespace longreach
