#include "tests/faults/invariant.hpp"

#include <cstdio>

namespace longreach {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

}  // namespace

void Invariant::at_most(const Moment& moment, double value, double bound, const char* what) {
  ++judged_;
  if (value <= bound) return;
  break_it(moment, std::string(what) + " " + number(value) + ", at most " + number(bound));
}

void Invariant::that(const Moment& moment, bool good, const char* what) {
  ++judged_;
  if (!good) break_it(moment, what);
}

void Invariant::break_it(const Moment& moment, std::string words) {
  if (violated_++ == 0) first_ = {std::string(name_), moment.t_s, std::move(words)};
}

Invariants all_invariants(const Scenario& scenario) {
  Invariants all;
  for (const auto& add :
       {add_joint_invariants, add_tool_invariants, add_authority_invariants, add_state_invariants,
        add_command_invariants, add_contact_invariants, add_hand_invariants, add_goal_invariants,
        add_display_invariants, add_implausible_invariants, add_liveness}) {
    add(scenario, all);
  }
  return all;
}

}  // namespace longreach
