#pragma once
// The rows of the experiment `person`. Each row specifies the behaviour of a simulated person and the
// required results.

#include <string>
#include <vector>

#include "deploy/lab/person/person_run.hpp"

namespace longreach {

struct PersonCheck {
  std::string what;
  double value = 0.0, most = 0.0;  // the check passes if value <= most
};

struct PersonRow {
  const char* name;
  const char* what;
  void (*prepare)(PersonScenario& scenario);
  std::vector<PersonCheck> (*judge)(const PersonScenario& scenario, const PersonSeen& seen);
  /// The result depends on the position of the tool in the reports: without it, at least one check must fail
  /// (the control).
  bool by_place = false;
};

/// Returns all rows.
const std::vector<PersonRow>& person_rows();

/// Adds rows with a hand at rest, which check the displayed force and the stability.
void add_resting_hands(std::vector<PersonRow>& rows);

/// Adds rows with surfaces on either side of the tool, touches from behind, surfaces known before the
/// engagement, nonlinear contact laws, and stops.
void add_oriented_surfaces(std::vector<PersonRow>& rows);

/// Adds cases that were already correct before this experiment was written, as regression tests.
void add_rows_that_stay(std::vector<PersonRow>& rows);

}  // namespace longreach
