#pragma once
// Energy from dissipation at the port, which the anchor of a spring may spend to return, J. Never below zero,
// never above its size (Franken et al., T-RO 2011, simplified). The store of an engagement is a tank that
// starts full: passivity permits the port its initial energy.

#include <algorithm>

namespace longreach {

class EnergyTank {
 public:
  explicit EnergyTank(double size_j) : size_j_(size_j) {}
  void resize(double size_j) {
    size_j_ = size_j;
    level_j_ = std::min(level_j_, size_j);
  }

  /// Adds `energy_j`, or takes a negative one. Returns the part that it could not add (>= 0) or take (<= 0).
  double fill(double energy_j) {
    const double before = level_j_;
    level_j_ = std::clamp(before + energy_j, 0.0, size_j_);
    return before + energy_j - level_j_;
  }
  /// Spends at most the available energy.
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

/// Energy source of a spring: the tank of its port, then the store of the engagement.
class EnergySource {
 public:
  EnergySource(EnergyTank& tank, EnergyTank* store = nullptr) : tank_(tank), store_(store) {}
  [[nodiscard]] double level_j() const { return tank_.level_j() + (store_ ? store_->level_j() : 0.0); }
  /// Spends at most the available energy.
  double spend(double energy_j) {
    const double from_tank = tank_.spend(energy_j);
    return from_tank + (store_ ? store_->spend(energy_j - from_tank) : 0.0);
  }

 private:
  EnergyTank& tank_;
  EnergyTank* store_;
};

}  // namespace longreach
