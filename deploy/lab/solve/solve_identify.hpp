#pragma once
// `longreach-lab solve identify`: stiffness, k, λ and n of a contact from a recording. Input: JSON objects,
// one per line, or CSV with a header (contact_table): t (s, rising), x (penetration in m; <= 0 is free
// space), f (N, positive when pushing) and, in all lines or in none, v (m/s; without it, from x by central
// differences, so that the answers lag by one line). Violations of the convention, such as a press with a
// negative sign or x in mm without that unit, are refused (contact_convention), mostly after the last line.
// Output, one answer per line:
//   {"t", "k", "lambda", "n", "stiffness", "secant", "sd": {of each}, "verdict"}
// stiffness is the tangent at the present depth, secant the elastic force over the depth, both N/m. null: no
// fit yet, or not identifiable. verdict: "not yet", "identified", "not identifiable", or a list by parameter.
// With estimator "all" there is one line for each estimator, after the last sample.

#include <iosfwd>
#include <string>
#include <vector>

namespace longreach {

struct IdentifyOptions {
  std::string estimator = "maximum-likelihood";
  double exponent = 1.5;          // of fixed-exponent
  double force_noise_n = 0.0;     // sd; 0: estimated from the recording
  double position_noise_m = 0.0;  // sd; 0: estimated from the recording
};

/// Names of the estimators, and "all".
std::vector<std::string> identify_estimators();

/// Returns 0; 2 after an unreadable line, which is named on `errors`.
int solve_identify(const IdentifyOptions& options, std::istream& in, std::ostream& out, std::ostream& errors);

}  // namespace longreach
