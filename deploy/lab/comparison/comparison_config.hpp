#pragma once
// Parameters of the textbook control laws with which the laboratory compares the rendering. Both sides use
// the same values.

namespace longreach {

struct ComparisonConfig {
  double handle_mass_kg = 0.2;           // mass m in the limit 2 m/T of the injected damping
  double wave_n_s_per_m = 10.0;          // WAVE: characteristic impedance b
  double coupling_n_per_m = 100.0;       // POSITION_POSITION: Kc
  double coupling_n_s_per_m = 10.0;      // POSITION_POSITION: B
  double slave_mass_kg = 0.5;            // mass of the admittance that moves the slave under a force
  double slave_n_s_per_m = 10.0;         // damping of that admittance, Bs
  double slave_speed_max_m_per_s = 0.5;  // maximum speed at which a lagging slave catches up
  double tank_level_j = 0.05;            // TANK: target level of the master's tank
  double tank_n_s_per_m_per_j = 400.0;   // TANK: damping that fills the tank, per missing joule
  double tank_share_per_s = 2.0;         // TANK: fraction of the level sent to the other side per second
};

}  // namespace longreach
