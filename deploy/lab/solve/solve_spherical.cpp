#include "deploy/lab/solve/solve_spherical.hpp"

#include "master/devices/spherical/spherical_kinematics.hpp"

namespace longreach {
namespace {

using solve_json::BadRequest;
using solve_json::Json;
using solve_json::number;

SphericalGeometry spherical_geometry(const Json& request) {
  const bool by_angles = request.contains("beta1") || request.contains("beta2");
  const bool by_axes = request.contains("u") || request.contains("v") || request.contains("w0");
  if (by_angles && by_axes)
    throw BadRequest("give either \"beta1\" and \"beta2\" or \"u\", \"v\" and \"w0\", not both");
  const double alpha1 = number(request, "alpha1"), alpha2 = number(request, "alpha2");
  if (by_axes) {
    return SphericalGeometry(SphericalAxes{alpha1, alpha2, solve_json::matrix3(request, "u"),
                                           solve_json::matrix3(request, "v"),
                                           solve_json::matrix3(request, "w0")});
  }
  return SphericalGeometry(
      SphericalAngles{alpha1, alpha2, number(request, "beta1"), number(request, "beta2")});
}

Json nearest(const SphericalKinematics& k, const Vector3& theta, const Quaternion& near) {
  const SphericalPose pose = k.forward(theta, {SolutionStatus::kFound, near});
  SolutionStatus status = pose.status;
  // If the iteration ends at a singularity, there may be no solution beyond it, or one in another assembly
  // mode.
  if (status != SolutionStatus::kFound && k.forward_all(theta).status == SolutionStatus::kNoSolution)
    status = SolutionStatus::kNoSolution;
  const bool found = status == SolutionStatus::kFound;
  return {{"R", found ? solve_json::to_json(pose.q.toRotationMatrix()) : Json::array()},
          {"iterations", pose.iterations},
          {"status", to_string(status)}};
}

}  // namespace

Json solve_spherical_ik(const Json& request) {
  solve_json::require_known(request, "", {"alpha1", "alpha2", "beta1", "beta2", "u", "v", "w0", "R"});
  const SphericalRoots roots =
      SphericalKinematics(spherical_geometry(request)).inverse_all(solve_json::rotation(request, "R"));
  const bool reached = roots.status != SolutionStatus::kNoSolution;
  return {{"theta", reached ? solve_json::roots(roots.first_rad, roots.second_rad) : Json::array()}};
}

Json solve_spherical_fk(const Json& request) {
  solve_json::require_known(request, "",
                            {"alpha1", "alpha2", "beta1", "beta2", "u", "v", "w0", "theta", "near"});
  const SphericalKinematics k(spherical_geometry(request));
  const Vector3 theta = solve_json::vector3(request, "theta");
  if (request.contains("near")) return nearest(k, theta, solve_json::rotation(request, "near"));
  const SphericalPoses poses = k.forward_all(theta);
  Json solutions = Json::array();
  for (int n = 0; n < poses.count; ++n)
    solutions.push_back(solve_json::to_json(poses.q[static_cast<std::size_t>(n)].toRotationMatrix()));
  return {{"solutions", solutions}};
}

}  // namespace longreach
