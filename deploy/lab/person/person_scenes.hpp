#pragma once
// Scenes and checks that are shared by several rows of the experiment `person`.

#include "deploy/lab/person/person_rows.hpp"

namespace longreach {

/// Maximum distance by which the goal may lead a blocked robot once the blockage has been reported to the master.
inline constexpr double kMostLead_m = 5e-3;
inline constexpr double kTolerance = 0.2, kNoise_n = 0.1;  // of a displayed force
inline constexpr double kSteady_n = 0.3;                   // permitted variation of a displayed force at rest
inline constexpr double kNothing_n = 0.2;                  // contact forces below this value count as zero

using PersonChecks = std::vector<PersonCheck>;

void clear(PersonScenario& s);
void in_mode(PersonScenario& s, MotionMode mode);
/// Adds a plane at this position in front of the tool, with the outward normal `normal`.
void add_wall(PersonScenario& s, double x_m, double stiffness_n_per_m,
              const Vector3& normal = -Vector3::UnitX());
void only_wall(PersonScenario& s, double x_m, double stiffness_n_per_m);
/// Makes a box the only surface of the scene. The tool touches the face that points towards the tool.
void only_box(PersonScenario& s, const Vector3& centre_m, const Vector3& size_m, double stiffness_n_per_m);

/// Force that a deflection of the handle commands at the hand in rate mode, N.
double commanded_n(const PersonScenario& s, double deflection_m);
double one_way(const PersonScenario& s);
PersonCheck answers(const PersonScenario& s, const MoveSeen& retreat);
PersonCheck lead_before(const PersonScenario& s, const PersonSeen& seen, std::size_t move);
PersonCheck lead_after(const PersonSeen& seen, std::size_t move);
PersonCheck in_front(const PersonSeen& seen);

}  // namespace longreach
