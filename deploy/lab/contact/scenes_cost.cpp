// The computing time of scenes: microseconds per step of the simulated robot and the slave's node with each
// scene in deploy/scenes, whether free bodies are built (1) or omitted (0), and of the contact alone where
// the tool touches something. Then with 1 to 10,000 surfaces, at rest (found through a bounding volume tree)
// and moving (tested one after the other), and with 1 to 4 free bodies in a row, separate and touching. Then
// with the robots of MuJoCo.
// Unlike those of other experiments, the results depend on the machine and its load.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "common/config/config.hpp"
#include "common/core/random.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/mjcf_robots.hpp"
#include "deploy/lab/trace.hpp"
#include "deploy/lab/trade/cost.hpp"
#include "slave/simulation/simulated_arm.hpp"
#include "slave/slave_node.hpp"

namespace longreach {
namespace {

constexpr int kSteps = 2000, kRowSteps = 50;

template <class Call>
double cost_us(int times, Call&& call) {
  return 1e-3 * cost_ns(times, call);
}

double slave_step_us(const SlaveConfig& config, SimulatedRobot& arm) {
  SlaveNode node(config);
  SlaveInput input;
  return cost_us(kSteps, [&](int) {
    input.now += std::chrono::milliseconds(1);
    input.robot = arm.read(input.now);
    arm.write(node.step(input).joint_setpoint_rad);
  });
}

/// Time of a read of the robot alone, while its joints hold a tool that is displaced by `way_m` along x.
double pressing_us(const SlaveConfig& config, SimulatedRobot& arm, double way_m) {
  const Kinematics kinematics(config.robot);
  const Pose& start = arm.start_pose();
  JointVector q = start_joints(config.robot);
  constexpr int kIterations = 20;
  for (int i = 0; i < kIterations; ++i) {
    const ToolKinematics at = kinematics.forward_with_jacobian(q);
    Eigen::Matrix<double, 6, 1> off;
    off << log_rotation(start.q * at.X_WE.q.conjugate()), start.p + Vector3(way_m, 0, 0) - at.X_WE.p;
    q += at.J.colPivHouseholderQr().solve(off);
  }
  Time now{};
  const auto tick = [&](int) {
    arm.write(q);
    arm.read(now += std::chrono::milliseconds(1));
  };
  for (int i = 0; i < kSteps; ++i) tick(i);
  return cost_us(kSteps, tick);
}

/// The robots of MuJoCo, in the scenes of longreach-mujoco, 1 mm in a surface and before it.
void mujoco_cost(std::vector<Metric>& metrics) {
  if (mjcf_robots == nullptr) return;
  constexpr double kBefore_m = 0.029, kIn_m = 0.031;
  for (const char* name : {"wall", "ball", "corner", "oblique"}) {
    try {
      const std::string file = "mujoco/scenes/" + std::string(name) + ".xml";
      const SlaveConfig config = to_struct(configure({"robot.mjcf=" + file}, find_deploy_folder()).slave());
      const auto arm = [&] { return mjcf_robots->make(config, Random(1)); };
      const std::string metric = "mujoco_" + std::string(name);
      metrics.push_back(
          {metric + "_step_us", slave_step_us(config, *arm()), "robot, contact and node", true});
      metrics.push_back(
          {metric + "_before_us", pressing_us(config, *arm(), kBefore_m), "only the robot", true});
      metrics.push_back(
          {metric + "_pressing_us", pressing_us(config, *arm(), kIn_m), "only the robot", true});
    } catch (const ConfigError& e) {
      std::fprintf(stderr, "scene skipped: %s\n",
                   e.what());  // longreach-mujoco, which has them, is not installed
    }
  }
}

struct ContactCost {
  double us = 0.0;
  double asked = 0.0;     // mean number of surfaces whose distance was computed
  double touching = 0.0;  // fraction of positions with contact
};

ContactCost contact_cost(const Scene& scene, const Vector3& centre_m, double reach_m) {
  Random random(1);
  std::vector<ToolMotion> tools(kSteps);
  ContactCost cost;
  for (ToolMotion& tool : tools) {
    tool.p_WE =
        centre_m + reach_m * Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    tool.q_WE = exp_rotation(0.1 * Vector3(random.normal(), random.normal(), random.normal()));
    const SceneContact c = scene.contact(tool);
    cost.asked += static_cast<double>(c.asked) / kSteps;
    cost.touching += c.contacts > 0 ? 1.0 / kSteps : 0.0;
  }
  double sum = 0.0;  // prevents the compiler from removing the computation
  cost.us = cost_us(kSteps, [&](int i) { sum += scene.contact(tools[static_cast<std::size_t>(i)]).depth_m; });
  if (!std::isfinite(sum)) cost.us = 0.0;
  return cost;
}

// Time of a step of the bodies, with the first body displaced by this, held or not.
double bodies_us(const SceneConfig& config, const Vector3& displaced_m, bool held) {
  Bodies bodies(config, Pose{});
  bodies.place(0, {bodies.body(0).X_start.p + displaced_m, bodies.body(0).X_start.q});
  const Pose tool{held ? bodies.to_fixture_m() : Vector3::Zero().eval(), Quaternion::Identity()};
  bodies.grip(held);
  return cost_us(kSteps, [&](int) { bodies.step(tool, 1e-3); });
}

/// A row of balls of 1 kg and 40 mm with these gaps; negative: they press on each other.
SceneConfig row_of_balls(int count, double gap_m) {
  SceneConfig scene;
  scene.material = {{"hard", 1e4, 0.001, 1.5, 0.1}};
  std::string world =
      "<body name='tool' pos='0 1 0'><freejoint/><geom type='sphere' size='0.02' mass='1' "
      "material='hard'/></body>\n";
  for (int i = 0; i < count; ++i) {
    world += "<body name='ball" + std::to_string(i) + "' pos='" + std::to_string((0.04 + gap_m) * i) +
             " 0 0'><freejoint/><geom type='sphere' size='0.02' mass='1' material='hard'/></body>\n";
  }
  scene.bodies.emplace();
  scene.bodies->mjcf_file = "row.xml";
  scene.bodies->file = {{"row.xml",
                         "<mujoco>\n<option gravity='0 0 0'/>\n<asset><material name='hard'/></asset>\n"
                         "<worldbody>\n" +
                             world + "</worldbody>\n</mujoco>\n"}};
  return scene;
}

/// Time of a step that starts with the row in its initial state.
double row_us(int count, double gap_m) {
  Bodies bodies(row_of_balls(count, gap_m), Pose{});
  const Pose away{{0.0, 1.0, 0.0}, Quaternion::Identity()};
  return cost_us(kRowSteps, [&](int) {
    for (int i = 0; i < count; ++i) bodies.place(i, bodies.body(i).X_start);
    bodies.step(away, 1e-3);
  });
}

void bodies_growth(const ExperimentRun& run, std::vector<Metric>& metrics) {
  Trace trace(run.out, "scenes_cost_bodies", {"bodies", "apart_us", "touching_us"});
  for (const int count : {1, 2, 3, 4}) {
    const double apart = row_us(count, 1e-3), touching = row_us(count, -1e-4);
    trace.row({static_cast<double>(count), apart, touching});
    metrics.push_back({std::to_string(count) + "_bodies_apart_us", apart, "only the bodies", true});
    metrics.push_back({std::to_string(count) + "_bodies_touching_us", touching, "only the bodies", true});
  }
  trace.close();
}

Scene many(int count, bool moving) {
  SceneConfig config;
  config.material.push_back({.name = "m"});
  Random random(2);
  for (int i = 0; i < count; ++i) {
    SurfaceConfig& s = config.surface.emplace_back();
    s.material = "m";
    s.sphere = SphereConfig{Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)),
                            0.02, false};
    if (moving) s.movement.emplace();
  }
  return Scene(config, Pose{});
}

std::vector<std::string> ready_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(find_deploy_folder() / "scenes")) {
    if (entry.path().extension() == ".txtpb") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::vector<Plot> scenes_cost_plots() {
  return {{.name = "scenes_cost",
           .csv = "scenes_cost",
           .title = "Spheres in a 2 m cube: spheres at rest are found with a tree; moving spheres are "
                    "tested one by one",
           .x_column = "surfaces",
           .x_label = "surfaces",
           .panels = {{"time per step (µs)",
                       {{"resting_us", "at rest"}, {"moving_us", "moving"}},
                       "set logscale xy\nset yrange [0.005:1000]\nset format y '%g'"},
                      {"distance computations",
                       {{"resting_asked", "at rest"}, {"moving_asked", "moving"}},
                       "set logscale xy\nset yrange [0.01:20000]\nset format y '%g'"}}},
          {.name = "scenes_cost_bodies",
           .csv = "scenes_cost_bodies",
           .title = "Free bodies in a row",
           .x_column = "bodies",
           .x_label = "bodies",
           .panels = {{"time per step (µs)",
                       {{"apart_us", "apart"}, {"touching_us", "touching each other"}},
                       "set xrange [0.8:4.2]\nset xtics 1\nset yrange [0:*]"}}}};
}

std::vector<Metric> run_scenes_cost(const ExperimentRun& run) {
  std::vector<Metric> metrics;
  const std::vector<std::string> scenes = ready_scenes();
  constexpr std::array kCounts{1, 3, 10, 30, 100, 300, 1000, 3000, 10000};
  double done = 0.0;
  const auto report = [&] {
    if (run.progress) run.progress(done++ / static_cast<double>(scenes.size() + kCounts.size() + 1));
  };
  for (const std::string& name : scenes) {
    report();
    proto::SlaveConfig message;
    message.set_scene_file("scenes/" + name + ".txtpb");
    try {
      resolve_files(message, find_deploy_folder());
    } catch (const ConfigError& e) {
      std::fprintf(stderr, "scene skipped: %s\n", e.what());  // a file that is being edited
      continue;
    }
    const SlaveConfig config = to_struct(message);
    SimulatedArm arm(config, Random(1));
    metrics.push_back({name + "_step_us", slave_step_us(config, arm), "robot, contact and node", true});
    if (name == "wall") {
      constexpr double kBefore_m = 0.104, kIn_m = 0.106;  // the wall is 105 mm in front of the tool
      SimulatedArm before(config, Random(1)), in(config, Random(1));
      metrics.push_back({"wall_before_us", pressing_us(config, before, kBefore_m), "only the robot", true});
      metrics.push_back({"wall_pressing_us", pressing_us(config, in, kIn_m), "only the robot", true});
    }
    metrics.push_back({name + "_builds_bodies", config.scene.bodies ? 1.0 : 0.0, "free bodies, MuJoCo"});
    if (config.scene.bodies) {
      const Vector3 docking_m{0.441, -0.45, 0.05};  // scene dock: the striker presses on the keeper
      metrics.push_back(
          {name + "_floating_us", bodies_us(config.scene, Vector3::Zero(), false), "only the bodies", true});
      metrics.push_back(
          {name + "_held_us", bodies_us(config.scene, Vector3::Zero(), true), "only the bodies", true});
      metrics.push_back(
          {name + "_pressing_us", bodies_us(config.scene, docking_m, true), "only the bodies", true});
      continue;
    }
    const Pose start = SimulatedArm(config, Random(1)).start_pose();
    const ContactCost cost = contact_cost(Scene(config.scene, start), start.p + Vector3(0.12, 0, 0), 0.05);
    metrics.push_back({name + "_contact_us", cost.us, "only the contact", true});
    metrics.push_back({name + "_touching", 100.0 * cost.touching, "% of the sampled positions"});
  }
  Trace trace(run.out, "scenes_cost",
              {"surfaces", "resting_us", "moving_us", "resting_asked", "moving_asked"});
  for (const int count : kCounts) {
    report();
    const ContactCost resting = contact_cost(many(count, false), Vector3::Zero(), 1.0);
    const ContactCost moving = contact_cost(many(count, true), Vector3::Zero(), 1.0);
    trace.row({static_cast<double>(count), resting.us, moving.us, resting.asked, moving.asked});
    metrics.push_back({std::to_string(count) + "_resting_us", resting.us, "only the contact", true});
    metrics.push_back({std::to_string(count) + "_moving_us", moving.us, "only the contact", true});
  }
  trace.close();
  report();
  bodies_growth(run, metrics);
  mujoco_cost(metrics);
  return metrics;
}

}  // namespace longreach
