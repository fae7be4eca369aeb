#pragma once
// Scenes and checks that several rows of the experiment `person` share.

#include "deploy/lab/person/person_rows.hpp"

namespace longreach {

inline constexpr double kMostLead_m = 5e-3;  // lead over a robot that is held back, once that is known
inline constexpr double kNothing_n = 0.2;    // counts as no contact force

using PersonChecks = std::vector<PersonCheck>;

void clear(PersonScenario& s);
void in_mode(PersonScenario& s, MotionMode mode);
/// A plane at this position in front of the tool, with its outward `normal`.
void add_wall(PersonScenario& s, double x_m, double stiffness_n_per_m,
              const Vector3& normal = -Vector3::UnitX());
void only_wall(PersonScenario& s, double x_m, double stiffness_n_per_m);
/// Touched at its face towards the tool.
void only_box(PersonScenario& s, const Vector3& centre_m, const Vector3& size_m, double stiffness_n_per_m);

double one_way(const PersonScenario& s);
PersonCheck answers(const PersonScenario& s, const MoveSeen& retreat);
PersonCheck lead_before(const PersonScenario& s, const PersonSeen& seen, std::size_t move);
PersonCheck lead_after(const PersonSeen& seen, std::size_t move);
PersonCheck in_front(const PersonSeen& seen);

}  // namespace longreach
