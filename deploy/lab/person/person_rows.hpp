#pragma once
// The rows of the experiment `person`: what a person does, and what must then be true.

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
  bool by_place = false;  // lives by the tool's place in the reports: without it a check must fail
};

/// All of them.
const std::vector<PersonRow>& person_rows();

/// Hands that rest: what they feel, and that it is calm.
void add_resting_hands(std::vector<PersonRow>& rows);

/// Surfaces on either side, met from behind, known before the engagement, curved laws, stops.
void add_oriented_surfaces(std::vector<PersonRow>& rows);

/// What was right before the experiment was, and is to stay so.
void add_rows_that_stay(std::vector<PersonRow>& rows);

}  // namespace longreach
