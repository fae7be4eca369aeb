#pragma once
// Invariants: properties that must hold under all faults. They are checked using data observed from outside
// (moment.hpp), never using internal data of a node. Reported states and causes are only claims, so they are
// checked too. Each invariant counts its checks, because an invariant without checks proves nothing.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tests/faults/moment.hpp"
#include "tests/faults/scenario.hpp"

namespace longreach {

struct Breach {
  std::string invariant;  // name of the invariant
  double t_s = 0.0;
  std::string words;
};

class Invariant {
 public:
  Invariant(std::string_view name, std::string_view says) : name_(name), says_(says) {}
  virtual ~Invariant() = default;

  /// Checks one tick.
  virtual void see(const Moment& moment) = 0;

  [[nodiscard]] std::string_view name() const { return name_; }
  [[nodiscard]] std::string_view says() const { return says_; }
  /// Number of checks.
  [[nodiscard]] std::uint64_t judged() const { return judged_; }
  [[nodiscard]] std::uint64_t violated() const { return violated_; }
  [[nodiscard]] const Breach& first() const { return first_; }

 protected:
  /// Checks that `value` is at most `bound`; NaN violates the invariant.
  void at_most(const Moment& moment, double value, double bound, const char* what);
  /// Checks that `good` is true.
  void that(const Moment& moment, bool good, const char* what);

 private:
  void break_it(const Moment& moment, std::string words);

  std::string_view name_, says_;
  std::uint64_t judged_ = 0, violated_ = 0;
  Breach first_{};
};

using Invariants = std::vector<std::unique_ptr<Invariant>>;

// Each of these functions adds the invariants of one file to `all`.
void add_joint_invariants(const Scenario& scenario, Invariants& all);
void add_tool_invariants(const Scenario& scenario, Invariants& all);
void add_authority_invariants(const Scenario& scenario, Invariants& all);
void add_state_invariants(const Scenario& scenario, Invariants& all);
void add_command_invariants(const Scenario& scenario, Invariants& all);
void add_contact_invariants(const Scenario& scenario, Invariants& all);
void add_hand_invariants(const Scenario& scenario, Invariants& all);
void add_goal_invariants(const Scenario& scenario, Invariants& all);
void add_display_invariants(const Scenario& scenario, Invariants& all);
void add_implausible_invariants(const Scenario& scenario, Invariants& all);
void add_liveness(const Scenario& scenario, Invariants& all);

Invariants all_invariants(const Scenario& scenario);

}  // namespace longreach
