#pragma once
// An energy tank (Franken et al., T-RO 2011, simplified). It collects energy dissipated at the port, which a
// spring may spend to return its anchor. The level, J, is always between zero and the size. The initial store
// of an engagement is a tank that starts full: passivity permits a port to have initial energy.

#include <algorithm>

namespace longreach {

class EnergyTank {
 public:
  explicit EnergyTank(double size_j) : size_j_(size_j) {}
  void resize(double size_j) {
    size_j_ = size_j;
    level_j_ = std::min(level_j_, size_j);
  }

  /// Adds `energy_j`, or removes energy if it is negative. Returns the part that could not be added (>= 0) or
  /// removed (<= 0).
  double fill(double energy_j) {
    const double before = level_j_;
    level_j_ = std::clamp(before + energy_j, 0.0, size_j_);
    return before + energy_j - level_j_;
  }
  /// Removes up to `energy_j`, limited by the level. Returns the energy that was removed.
  double spend(double energy_j) {
    const double spent = std::clamp(energy_j, 0.0, level_j_);
    level_j_ -= spent;
    return spent;
  }
  void empty() { level_j_ = 0.0; }
  [[nodiscard]] double level_j() const { return level_j_; }

 private:
  double size_j_;
  double level_j_ = 0.0;
};

/// Energy source of a spring: first the tank of its port, then the store of the engagement.
class EnergySource {
 public:
  EnergySource(EnergyTank& tank, EnergyTank* store = nullptr) : tank_(tank), store_(store) {}
  [[nodiscard]] double level_j() const { return tank_.level_j() + (store_ ? store_->level_j() : 0.0); }
  /// Removes up to `energy_j`, limited by the available energy. Returns the energy that was removed.
  double spend(double energy_j) {
    const double from_tank = tank_.spend(energy_j);
    return from_tank + (store_ ? store_->spend(energy_j - from_tank) : 0.0);
  }

 private:
  EnergyTank& tank_;
  EnergyTank* store_;
};

}  // namespace longreach
