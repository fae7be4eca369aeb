#pragma once
// The rows of the experiment `person`: the behaviour of a person, and the required results.

#include <string>
#include <vector>

#include "deploy/lab/person/person_run.hpp"

namespace longreach {

struct PersonCheck {
  std::string what;
  double value = 0.0, most = 0.0;  // a check holds where value <= most
};

struct PersonRow {
  const char* name;
  const char* what;
  void (*prepare)(PersonScenario& scenario);
  std::vector<PersonCheck> (*judge)(const PersonScenario& scenario, const PersonSeen& seen);
  bool by_place = false;  // depends on the position of the tool in the reports: without it a check must fail
};

/// All rows.
const std::vector<PersonRow>& person_rows();

/// Resting hands: displayed force and stability.
void add_resting_hands(std::vector<PersonRow>& rows);

/// Surfaces on either side, touched from behind, known before the engagement, curved laws, stops.
void add_oriented_surfaces(std::vector<PersonRow>& rows);

/// Cases that were correct before the experiment existed and must remain so.
void add_rows_that_stay(std::vector<PersonRow>& rows);

}  // namespace longreach
