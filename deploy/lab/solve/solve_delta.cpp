#include "deploy/lab/solve/solve_delta.hpp"

#include <numbers>

#include "master/devices/delta/delta_kinematics.hpp"
#include "master/devices/delta/delta_statics.hpp"

namespace longreach {
namespace {

using solve_json::BadRequest;
using solve_json::Json;
using solve_json::number;
using solve_json::vector3;

std::array<double, 3> azimuths(const Json& g) {
  const Vector3 rad = vector3(g, "azimuth_deg") * (std::numbers::pi / 180.0);
  return {rad[0], rad[1], rad[2]};
}

DeltaGeometry delta_geometry(const Json& request) {
  const Json& g = solve_json::object_member(request, "geometry");
  const std::string type = solve_json::text(g, "type");
  if (type == "simple") {
    solve_json::require_known(g, "geometry", {"type", "a", "l1", "l2", "azimuth_deg"});
    return DeltaGeometry(DeltaSimple{number(g, "a"), number(g, "l1"), number(g, "l2"), azimuths(g)});
  }
  if (type == "general") {
    solve_json::require_known(g, "geometry", {"type", "a", "b", "c", "d", "e", "f", "r", "s", "azimuth_deg"});
    return DeltaGeometry(DeltaGeneral{number(g, "a"), number(g, "b"), number(g, "c"), number(g, "d"),
                                      number(g, "e"), number(g, "f"), number(g, "r"), number(g, "s"),
                                      azimuths(g)});
  }
  throw BadRequest("\"type\" must be \"simple\" or \"general\"");
}

DeltaMasses masses(const Json& request) {
  const Json& m = solve_json::object_member(request, "masses");
  solve_json::require_known(m, "masses", {"platform", "arm", "arm_com_fraction", "forearm"});
  const DeltaMasses result{number(m, "platform"), number(m, "arm"), number(m, "arm_com_fraction"),
                           number(m, "forearm")};
  require_valid(result);
  return result;
}

/// A closed pose, given by its position (first working mode) or its angles (working assembly mode).
struct ClosedPose {
  bool exists = false;
  Vector3 theta = Vector3::Zero();
  Vector3 p = Vector3::Zero();
};

ClosedPose closed_pose(const Json& request, const DeltaKinematics& k) {
  if (request.contains("p") == request.contains("theta"))
    throw BadRequest("give the pose as either \"p\" or \"theta\"");
  if (request.contains("p")) {
    const Vector3 p = vector3(request, "p");
    const DeltaAngles angles = k.inverse(p);
    return {angles.status != SolutionStatus::kNoSolution, angles.theta_rad, p};
  }
  const Vector3 theta = vector3(request, "theta");
  const DeltaPositions positions = k.forward_all(theta);
  return {positions.status == SolutionStatus::kFound, theta, positions.p_m[0]};
}

}  // namespace

Json solve_delta_ik(const Json& request) {
  solve_json::require_known(request, "", {"geometry", "p"});
  const DeltaRoots roots = DeltaKinematics(delta_geometry(request)).inverse_all(vector3(request, "p"));
  const bool reached = roots.status != SolutionStatus::kNoSolution;
  return {{"theta", reached ? solve_json::roots(roots.first_rad, roots.second_rad) : Json::array()}};
}

Json solve_delta_fk(const Json& request) {
  solve_json::require_known(request, "", {"geometry", "theta"});
  const DeltaPositions positions =
      DeltaKinematics(delta_geometry(request)).forward_all(vector3(request, "theta"));
  Json solutions = Json::array();
  for (int n = 0; n < positions.count; ++n)
    solutions.push_back(solve_json::to_json(positions.p_m[static_cast<std::size_t>(n)]));
  return {{"solutions", solutions}};
}

Json solve_delta_statics(const Json& request) {
  solve_json::require_known(request, "", {"geometry", "p", "theta", "masses", "gravity"});
  const DeltaKinematics k(delta_geometry(request));
  const DeltaMasses m = masses(request);
  const Vector3 gravity = vector3(request, "gravity");
  const ClosedPose pose = closed_pose(request, k);
  if (!pose.exists) return {{"tau", Json::array()}};
  const DeltaVelocity at = velocity(k.geometry(), pose.theta, pose.p);
  const DeltaTorques torques = gravity_torques(k.geometry(), m, gravity, pose.theta, at);
  if (torques.status != SolutionStatus::kFound)
    throw BadRequest("the pose is singular: no motor torques can hold it");
  return {{"tau", solve_json::to_json(torques.tau_nm)}};
}

}  // namespace longreach
