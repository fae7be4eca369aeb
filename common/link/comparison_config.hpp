#pragma once
// Parameters of the textbook laws that the laboratory compares with; both sides use the same values.

namespace longreach {

struct ComparisonConfig {
  double handle_mass_kg = 0.2;           // bounds the injected damping: 2 m/T
  double wave_n_s_per_m = 10.0;          // WAVE: characteristic impedance b
  double coupling_n_per_m = 100.0;       // POSITION_POSITION: Kc
  double coupling_n_s_per_m = 10.0;      // POSITION_POSITION: B
  double slave_mass_kg = 0.5;            // of the admittance that moves the slave under a force
  double slave_n_s_per_m = 10.0;         // its own damping, Bs
  double slave_speed_max_m_per_s = 0.5;  // speed at which a lagging slave catches up
  double tank_level_j = 0.05;            // TANK: level that the master fills up to
  double tank_n_s_per_m_per_j = 400.0;   // damping that fills it, per missing joule
  double tank_share_per_s = 2.0;         // of the level, sent to the other side
};

}  // namespace longreach
