#include "tests/peers/peers.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <kdl/chainiksolverpos_lma.hpp>
#include <memory>
#include <stdexcept>
#include <vector>

#include "common/config/config.hpp"
#include "deploy/lab/trade/arm_goals.hpp"
#include "slave/simulation/scene/bodies.hpp"
#include "slave/simulation/scene/scene.hpp"
#include "tests/oracle/kdl_chain.hpp"
#include "tests/oracle/simbody/simbody_ball.hpp"

namespace longreach {
namespace {

constexpr int kCalls = 200;
const Vector3 kPressing_m(0.441, -0.45, 0.05);  // of scene `dock`: the striker presses the keeper

double cost_of(const std::vector<TradePoint>& points, std::string_view series) {
  const auto found = std::ranges::find(points, series, &TradePoint::series);
  if (found == points.end()) throw std::logic_error("peers: there is no series " + std::string(series));
  return found->cost;
}

/// A ball pressed 1 mm into a half space: its force.
double simbody_over_ours() {
  constexpr double kRadius_m = 0.05, kModulus_pa = 1e6;
  oracle::SimbodyBall theirs(kRadius_m, kModulus_pa, 0.1);
  SceneConfig config;
  config.material = {{"m", 1e5, 1.0, 1.5, 0.15}};
  config.tool_radius_m = kRadius_m;
  config.surface.push_back({.name = "floor", .material = "m"});
  config.surface[0].plane = PlaneConfig{Vector3::Zero(), Vector3::UnitZ(), false};
  const Scene ours(config, Pose{});
  const auto z = [](int i) { return kRadius_m - 1e-3 - 1e-6 * i; };
  double sum = 0.0;
  const double theirs_ns = cost_ns(kCalls, [&](int i) {
    sum += theirs.force_n({0, 0, z(i)}, {0, 0, -0.01})[2];
  });
  const double ours_ns = cost_ns(kCalls, [&](int i) {
    sum += ours.contact({Vector3(0, 0, z(i)), Vector3(0, 0, -0.01)}).force_n.z();
  });
  return std::isfinite(sum) ? theirs_ns / ours_ns : NAN;
}

/// A step of 1 ms of the bodies of `dock`, the spacecraft's striker pressing on the keeper.
double mujoco_over_ours() {
  proto::SlaveConfig message;
  message.set_scene_file("scenes/dock.txtpb");
  resolve_files(message, find_deploy_folder());
  const SlaveConfig config = to_struct(message);
  Bodies bodies(config.scene, Pose{});
  bodies.place(0, {bodies.body(0).X_start.p + kPressing_m, bodies.body(0).X_start.q});
  bodies.grip(true);
  const Pose tool{bodies.to_fixture_m(), Quaternion::Identity()};
  const double ours_ns = cost_ns(kCalls, [&](int) { bodies.step(tool, 1e-3); });

  char why[500] = "";
  const std::string file = find_deploy_folder() / message.scene().bodies().mjcf_file();
  const std::unique_ptr<mjModel, decltype(&mj_deleteModel)> model(
      mj_loadXML(file.c_str(), nullptr, why, sizeof why), mj_deleteModel);
  if (!model) throw std::runtime_error("peers: " + file + ": " + why);
  const std::unique_ptr<mjData, decltype(&mj_deleteData)> data(mj_makeData(model.get()), mj_deleteData);
  model->opt.timestep = 1e-3;
  const int spacecraft = mj_name2id(model.get(), mjOBJ_BODY, "spacecraft");
  const int at = model->jnt_qposadr[model->body_jntadr[spacecraft]];
  for (int i = 0; i < 3; ++i) data->qpos[at + i] += kPressing_m[i];
  const std::vector<mjtNum> pressing(data->qpos, data->qpos + model->nq);
  // Back to where it presses, and no more: mj_resetData costs as much as a step.
  const double theirs_ns = cost_ns(kCalls, [&](int) {
    mju_copy(data->qpos, pressing.data(), model->nq);
    mju_zero(data->qvel, model->nv);
    mj_step(model.get(), data.get());
  });
  return theirs_ns / ours_ns;
}

/// KDL on the goals of the stage `arm_inverse`.
TradePoint kdl_inverse(std::uint64_t seed) {
  TradePoint point{"kdl", ""};
  const auto arms = test::ready_arms();
  for (const test::NamedArm& arm : arms) {
    const Inverse inverse(arm.robot);
    const ArmGoals g = arm_goals(inverse.kinematics(), Random(seed).child("trade " + arm.name));
    const KDL::Chain chain = oracle::kdl_chain(arm.robot);
    KDL::ChainIkSolverPos_LMA kdl(chain);
    KDL::JntArray out(kMaxJoints);
    const auto solve = [&](const Pose& goal, const JointVector& from, JointVector& q) {
      const auto& r = goal.q;
      kdl.CartToJnt(
          oracle::kdl_joints(from),
          {KDL::Rotation::Quaternion(r.x(), r.y(), r.z(), r.w()), {goal.p.x(), goal.p.y(), goal.p.z()}}, out);
      for (int i = 0; i < q.size(); ++i) q[i] = out(static_cast<unsigned>(i));
    };
    measure_inverse(point, inverse.kinematics(), g, 1.0 / static_cast<double>(arms.size()), solve);
  }
  return point;
}

}  // namespace

std::vector<Metric> run_peers(const ExperimentRun& run) {
  const auto metric = [](const char* name, double ratio) { return Metric{name, ratio, "times ours", true}; };
  const std::vector<TradePoint> arm = trade_arm_inverse().measure(run);
  const std::vector<TradePoint> estimator = trade_estimator().measure(run);
  const TradePoint kdl = kdl_inverse(run.seed);
  return {
      metric("kdl_inverse", kdl.cost / cost_of(arm, "closed_form")),
      {"kdl_inverse_error", kdl.error, "of the reach"},
      metric("ceres_batch_fit", cost_of(estimator, "batch_fit") / cost_of(estimator, "maximum_likelihood")),
      metric("simbody_contact_force", simbody_over_ours()),
      metric("mujoco_contact_step", mujoco_over_ours())};
}

}  // namespace longreach
