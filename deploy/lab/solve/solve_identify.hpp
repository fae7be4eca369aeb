#pragma once
// `longreach-lab solve identify`: estimates the stiffness, k, λ and n of a contact from a recording. The
// input is JSON objects, one per line, or CSV with a header (contact_table.hpp), with t (s, increasing), x
// (penetration in m; <= 0 is free space), f (N, positive when pushing) and, in all lines or in none, v (m/s).
// Without v, the speed is computed from x by central differences, and the output lags by one line. Violations
// of these conventions, such as forces with the wrong sign or x in mm without a stated unit, are rejected
// (contact_convention.hpp), mostly after the last line. The output is one result per line:
//   {"t", "k", "lambda", "n", "stiffness", "secant", "sd": {of each}, "verdict"}
// stiffness is the tangent stiffness at the current depth, and secant the elastic force divided by the depth,
// both in N/m. In free space and near the surface (less than 2 % of the largest depth), and with the estimator "all",
// they refer to the largest depth on the present object, where the tool pressed hardest; a depth can also be given. A value is null if there is no fit yet or if it is not identifiable. verdict is "not yet",
// "identified" or "not identifiable", or a list with one of these per parameter. With the estimator "all" the
// output is one line per estimator, after the last sample.

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace longreach {

struct IdentifyOptions {
  std::string estimator = "maximum-likelihood";
  double exponent = 1.5;            // exponent assumed by the fixed-exponent estimator
  double force_noise_n = 0.0;       // standard deviation; 0: estimated from the recording
  double position_noise_m = 0.0;    // standard deviation; 0: estimated from the recording
  std::optional<double> depth_m{};  // depth of stiffness and secant
};

/// Returns the names of the estimators, and "all".
std::vector<std::string> identify_estimators();

/// Returns 0 on success, or 2 after an invalid line, which is reported on `errors`.
int solve_identify(const IdentifyOptions& options, std::istream& in, std::ostream& out, std::ostream& errors);

}  // namespace longreach
