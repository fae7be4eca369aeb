#pragma once
// The rows of the experiment `person`. Each row specifies what a simulated person does and which results are
// required.

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
  /// The result depends on the tool position in the reports. As a control, at least one check must fail if
  /// the reports lack this position.
  bool by_place = false;
};

/// Returns all rows.
const std::vector<PersonRow>& person_rows();

/// Adds rows in which the hand is at rest. They check the displayed force and the stability.
void add_resting_hands(std::vector<PersonRow>& rows);

/// Adds rows with surfaces on either side of the tool, touches from behind, surfaces known before the
/// engagement, nonlinear contact laws, and stops.
void add_oriented_surfaces(std::vector<PersonRow>& rows);

/// Adds rows with corners, a groove and an edge.
void add_shapes(std::vector<PersonRow>& rows);

/// Adds cases that already passed before this experiment was written, as regression tests.
void add_rows_that_stay(std::vector<PersonRow>& rows);

}  // namespace longreach
