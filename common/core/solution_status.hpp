#pragma once
// Result of a kinematic solver. The header of each solver states what its output is for each status.

#include <cstdint>
#include <string_view>

namespace longreach {

enum class SolutionStatus : std::uint8_t {
  kFound,        // the output is the solution
  kNoSolution,   // no solution exists, or the input is not finite
  kSingular,     // the mechanism loses or gains a degree of freedom: two solution branches coincide
  kNotConverged  // the maximum number of iterations was reached
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
