#include "tests/oracle/simbody/simbody_ball.hpp"

#include <Simbody.h>

namespace longreach::oracle {

struct SimbodyBall::System {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};
  SimTK::GeneralContactSubsystem contacts{system};
  SimTK::MobilizedBody::Cartesian ball{
      matter.updGround(), SimTK::Body::Rigid(SimTK::MassProperties(1.0, SimTK::Vec3(0), SimTK::Inertia(1)))};
  SimTK::State state;
};

SimbodyBall::SimbodyBall(double radius_m, double modulus_pa, double dissipation_s_per_m)
    : system_(std::make_unique<System>()) {
  System& s = *system_;
  const SimTK::ContactSetIndex set = s.contacts.createContactSet();
  s.contacts.addBody(set, s.ball, SimTK::ContactGeometry::Sphere(radius_m), SimTK::Transform());
  // The half space of Simbody is x > 0: turned so that it lies below z = 0.
  s.contacts.addBody(set, s.matter.updGround(), SimTK::ContactGeometry::HalfSpace(),
                     SimTK::Transform(SimTK::Rotation(0.5 * SimTK::Pi, SimTK::YAxis)));
  SimTK::HuntCrossleyForce law(s.forces, s.contacts, set);
  for (const int i : {0, 1})
    law.setBodyParameters(SimTK::ContactSurfaceIndex(i), modulus_pa, dissipation_s_per_m, 0.0, 0.0, 0.0);
  s.system.realizeTopology();
  s.state = s.system.getDefaultState();
}

SimbodyBall::~SimbodyBall() = default;

std::array<double, 3> SimbodyBall::force_n(const std::array<double, 3>& p, const std::array<double, 3>& v) {
  System& s = *system_;
  s.ball.setQToFitTranslation(s.state, SimTK::Vec3(p[0], p[1], p[2]));
  s.ball.setUToFitLinearVelocity(s.state, SimTK::Vec3(v[0], v[1], v[2]));
  s.system.realize(s.state, SimTK::Stage::Dynamics);
  const SimTK::SpatialVec& all =
      s.system.getRigidBodyForces(s.state, SimTK::Stage::Dynamics)[s.ball.getMobilizedBodyIndex()];
  return {all[1][0], all[1][1], all[1][2]};
}

}  // namespace longreach::oracle
