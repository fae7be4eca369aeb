#pragma once
// Figures of the textbook laws that the laboratory compares with; master and slave use the same ones.

namespace longreach {

struct ComparisonConfig {
  double handle_mass_kg = 0.2;           // bounds the injected damping: 2 m/T
  double wave_n_s_per_m = 10.0;          // WAVE: characteristic impedance b
  double coupling_n_per_m = 100.0;       // POSITION_POSITION: Kc
  double coupling_n_s_per_m = 10.0;      // POSITION_POSITION: B
  double slave_mass_kg = 0.5;            // of the admittance that moves the slave under a force
  double slave_n_s_per_m = 10.0;         // its own damping, Bs
  double slave_speed_max_m_per_s = 0.5;  // at which a slave that fell behind catches up
  double tank_level_j = 0.05;            // TANK: level that the master fills up to
  double tank_n_s_per_m_per_j = 400.0;   // damping that fills it, per joule that is missing
  double tank_share_per_s = 2.0;         // of the level, sent to the other side
};

}  // namespace longreach
