#include "deploy/lab/devices/delta_catalog.hpp"

#include <numbers>

namespace longreach {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;

}  // namespace

DeltaDesign reconstructed_delta() {
  return {DeltaGeometry(DeltaSimple{0.027, 0.061, 0.095, {0.0, 240.0 * kDegree_rad, 120.0 * kDegree_rad}}),
          {0.018, 0.0273, 0.5, 0.005},
          {0.0, 0.0, -0.0903}};
}

DeltaDesign novint_falcon() {
  return {DeltaGeometry(DeltaGeneral{0.060,
                                     0.1025,
                                     0.01443,
                                     0.01125,
                                     0.01125,
                                     -0.025,
                                     0.0400,
                                     -0.02309,
                                     {105.0 * kDegree_rad, -15.0 * kDegree_rad, -135.0 * kDegree_rad}}),
          {0.10, 0.05, 0.5, 0.02},
          {0.0, 0.0, 0.11}};
}

DeltaDesign omega_like() {
  return {DeltaGeometry(DeltaSimple{0.060, 0.110, 0.200, {0.0, 120.0 * kDegree_rad, 240.0 * kDegree_rad}}),
          {0.12, 0.10, 0.4, 0.05},
          {0.0, 0.0, -0.17}};
}

}  // namespace longreach
