// No solver of the haptic devices asks for memory.

#include <gtest/gtest.h>

#include <cmath>

#include "deploy/lab/devices/delta_catalog.hpp"
#include "deploy/lab/devices/spherical_catalog.hpp"
#include "master/devices/delta/delta_kinematics.hpp"
#include "master/devices/spherical/spherical_kinematics.hpp"
#include "master/devices/spherical/spherical_statics.hpp"
#include "tests/support/allocations.hpp"

namespace longreach::device_allocation_test {
namespace {

template <class Work>
long allocations_of(const Work& work) {
  test::count_allocations(true);
  for (int i = 0; i < 100; ++i) work(1e-4 * i);
  test::count_allocations(false);
  return test::allocations();
}

TEST(DeltaKinematics, AllocatesNothing) {
  for (const DeltaDesign& design : {omega_like(), novint_falcon()}) {
    const DeltaKinematics k(design.geometry);
    double sum = 0.0;
    EXPECT_EQ(allocations_of([&](double x) {
                const Vector3 p = design.home_m + Vector3(x, -x, 0.5 * x);
                const Vector3 theta = k.inverse(p).theta_rad;
                const DeltaVelocity at = velocity(design.geometry, theta, p);
                sum += k.inverse_all(p).second_rad.sum();
                sum += k.forward(theta, design.geometry.working_assembly(), p).p_m.sum();
                sum += k.forward_all(theta).count;
                sum += statics(at, Vector3::UnitX()).tau_nm.sum();
                sum +=
                    gravity_torques(design.geometry, design.masses, Vector3::UnitZ(), theta, at).tau_nm.sum();
              }),
              0);
    EXPECT_TRUE(std::isfinite(sum));
  }
}

TEST(SphericalKinematics, AllocatesNothing) {
  const SphericalKinematics k(reconstructed_spherical());
  SphericalPose pose{SolutionStatus::kFound, Quaternion::Identity(), 0, 0};
  double sum = 0.0;
  EXPECT_EQ(allocations_of([&](double x) {
              const Quaternion q = exp_rotation({x, 2.0 * x, -x});
              const Vector3 theta = k.inverse(q).theta_rad;
              pose = k.forward(theta, pose);
              sum += k.inverse_all(q).first_rad.sum() + k.forward_all(theta).count;
              sum += statics(velocity(k.geometry(), theta, q), Vector3::UnitX()).nm.sum();
            }),
            0);
  EXPECT_TRUE(std::isfinite(sum));
}

}  // namespace
}  // namespace longreach::device_allocation_test
