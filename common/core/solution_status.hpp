#pragma once
// How a kinematic solver ended. Each solver's header says which output comes with which status.

#include <cstdint>
#include <string_view>

namespace longreach {

enum class SolutionStatus : std::uint8_t {
  kFound,        // the output is the solution
  kNoSolution,   // there is none, or the input is not finite
  kSingular,     // the mechanism loses or gains a freedom here: no branch can be told from another
  kNotConverged  // the bounded iteration ended before the solution
};

constexpr std::string_view to_string(SolutionStatus status) {
  switch (status) {
    case SolutionStatus::kFound:
      return "FOUND";
    case SolutionStatus::kNoSolution:
      return "NO_SOLUTION";
    case SolutionStatus::kSingular:
      return "SINGULAR";
    case SolutionStatus::kNotConverged:
      return "NOT_CONVERGED";
  }
  return "NO_SOLUTION";
}

}  // namespace longreach
