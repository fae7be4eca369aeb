#pragma once
// The comparison laws that the master can run instead of its own rendering, as one closed variant.

#include <variant>

#include "deploy/lab/comparison/direct_law.hpp"
#include "deploy/lab/comparison/passivity_law.hpp"
#include "deploy/lab/comparison/position_position_law.hpp"
#include "deploy/lab/comparison/tank_law.hpp"
#include "deploy/lab/comparison/wave_law.hpp"
#include "master/config/rendering_config.hpp"

namespace longreach {

using ComparisonLaw = std::variant<DirectLaw, PositionPositionLaw, WaveLaw, PassivityLaw, TankLaw>;

/// Returns whether `law` needs ComparisonReports, which only the laboratory exchanges.
constexpr bool is_comparison(RenderingLaw law) {
  return law != RenderingLaw::kStiffness && law != RenderingLaw::kNaive;
}

/// Returns `law` in its initial state, or DIRECT if `law` is not a comparison law.
inline ComparisonLaw make_comparison_law(RenderingLaw law, const ComparisonConfig& config) {
  switch (law) {
    case RenderingLaw::kPositionPosition:
      return PositionPositionLaw(config);
    case RenderingLaw::kWave:
      return WaveLaw(config);
    case RenderingLaw::kTdpa:
      return PassivityLaw(config);
    case RenderingLaw::kTank:
      return TankLaw(config);
    default:
      return DirectLaw{};
  }
}

inline ComparisonOutput step(ComparisonLaw& law, const ComparisonInput& in, double dt_s) {
  return std::visit([&](auto& l) { return l.step(in, dt_s); }, law);
}

}  // namespace longreach
