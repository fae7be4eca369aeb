// A robot of MuJoCo in the laboratory: what is felt, against the springs of the scene and MuJoCo's contacts.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sstream>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "deploy/lab/mjcf_robots.hpp"
#include "deploy/lab/robot/mujoco_arm.hpp"
#include "deploy/lab/settings_used.hpp"
#include "deploy/lab/touch.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::mujoco_arm_test {
namespace {

using Values = std::map<std::string, double>;

const std::string kScenes = std::string(LONGREACH_DEPLOY) + "/mujoco/scenes/";
constexpr double kWall_n_per_m = 5000.0;  // of the spring in wall.xml

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

std::string replaced(std::string text, const std::string& part, const std::string& by) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return at == std::string::npos ? text : text.replace(at, part.size(), by);
}

class MujocoArmTest : public testing::Test {
 protected:
  void SetUp() override { use_mujoco(); }
  void TearDown() override { mjcf_robots = nullptr; }

  static ExperimentRun configured(std::vector<std::string> settings, std::uint64_t seed = 1) {
    if (settings.empty() || !settings.front().starts_with("robot.mjcf"))
      settings.insert(settings.begin(), "robot.mjcf=" + kScenes + "wall.xml");
    ExperimentRun run;
    run.config = configure(settings, LONGREACH_DEPLOY);
    run.seed = seed;
    return run;
  }
  static Values touch(const std::vector<std::string>& settings, std::uint64_t seed) {
    Values values;
    for (const Metric& m : run_touch(configured(settings, seed))) values[m.name] = m.value;
    return values;
  }
  static SlaveConfig slave(const std::vector<std::string>& settings) {
    return to_struct(configured(settings).config.slave());
  }
  /// The error of a configuration or of a run of one second.
  static std::string error_of(const std::vector<std::string>& settings) {
    try {
      const ExperimentRun run = configured(settings);
      Laboratory lab(to_struct(run.config.master()), to_struct(run.config.slave()), run.seed);
      while (lab.now_s() < 1.0) lab.step();
    } catch (const std::exception& problem) {
      return problem.what();
    }
    return "";
  }
  /// wall.xml and its arm, each with one part replaced, as a file of the test.
  std::string scene(const std::string& of_arm, const std::string& arm_by, const std::string& of_wall = "wall",
                    const std::string& wall_by = "wall") {
    std::ofstream(folder_.path() / "arm.xml") << replaced(text_of(kScenes + "arm.xml"), of_arm, arm_by);
    const std::filesystem::path file = folder_.path() / "scene.xml";
    std::ofstream(file) << replaced(text_of(kScenes + "wall.xml"), of_wall, wall_by);
    return file.string();
  }
  TemporaryFolder folder_;
};

// With seed 7, the place of the surface changes over `moon` while the operator probes, so its slope is 9 % off. With seeds 5 and
// 9, a light touch follows a hard one; the place of the surface, which is off by a part of the depth of the hard one, must not
// make the slave forget it.
TEST_F(MujocoArmTest, AWallIsFeltWithinFivePercentOfItsSpring) {
  const std::map<std::string, std::vector<std::uint64_t>> seeds{{"lab", {1, 2, 3}},
                                                                {"moon", {1, 2, 5, 6, 7, 9}}};
  for (const auto& [profile, all] : seeds) {
    for (const std::uint64_t seed : all) {
      const bool replaced = profile == "moon" && seed == 7;
      const Values v = touch({"profile=" + profile}, seed);
      SCOPED_TRACE(profile + ", seed " + std::to_string(seed));
      std::printf("%s, seed %llu: displayed %.0f N/m, due %.0f N/m, error %.4f\n", profile.c_str(),
                  static_cast<unsigned long long>(seed), v.at("displayed_stiffness_n_per_m"),
                  v.at("reference_stiffness_n_per_m"), v.at("displayed_stiffness_error"));
      // In series with a contact that is 50 times as stiff.
      EXPECT_NEAR(v.at("reference_stiffness_n_per_m"), kWall_n_per_m, 0.02 * kWall_n_per_m);
      EXPECT_LT(v.at("displayed_stiffness_error"), replaced ? 0.12 : 0.05);
      EXPECT_GT(v.at("displayed_span_s"), 4.0);
      EXPECT_EQ(v.at("probing_cycles_done"), 1.0);
      EXPECT_NEAR(v.at("geom_force_max_n.wall"), v.at("tool_force_peak_n"), 1e-9);
      EXPECT_EQ(v.at("false_holds"), 0.0);
      EXPECT_EQ(v.at("limit_violations"), 0.0);
      EXPECT_EQ(v.at("sensor_faulted"), 0.0);
    }
  }
}

TEST_F(MujocoArmTest, PersonFindsItsWallsInFrontOfTheArm) {
  ExperimentRun run = configured({"robot.mjcf=" + kScenes + "free.xml"});
  const auto person = [&run](const std::string& only) {
    run.only = only;
    Values values;
    for (const Metric& m : find_experiment("person")->run(run)) values[m.name] = m.value;
    return values;
  };
  const Values felt = person("move-and-wait,lab,firm");
  EXPECT_EQ(felt.at("trials"), 1.0);
  EXPECT_EQ(felt.at("failed_move-and-wait"), 0.0);
  const Values hinge = person("hinge,lab,firm");
  EXPECT_EQ(hinge.at("trials"), 0.0);
  EXPECT_EQ(hinge.at("left_out_hinge"), 1.0);
  EXPECT_FALSE(hinge.contains("failed_hinge"));
}

// The estimate drifts while the tool rests on a wall with friction, and the goal follows it out of the wall.
TEST_F(MujocoArmTest, NoForceStaysWhereTheToolIsFree) {
  ExperimentRun run = configured({"robot.mjcf=" + kScenes + "free.xml", "robot.servo_hz=20"});
  for (const char* link : {"lab", "moon"}) {
    run.only = std::string("held-out-long,") + link + ",firm";
    int checks = 0;
    run.check = [&](const TrialCheck& c) {
      if (c.what.find("the tool is free") == std::string::npos) return;
      EXPECT_LE(c.value, c.most) << c.trial;
      ++checks;
    };
    (void)find_experiment("person")->run(run);
    EXPECT_EQ(checks, 1);
  }
}

TEST_F(MujocoArmTest, ARunIsDeterminedByItsSeed) {
  const auto trace = [this](const std::string& name, std::uint64_t seed) {
    ExperimentRun run = configured({"profile=lab", "trace_hz=1000", "duration_s=12"}, seed);
    run.out = folder_.path() / name;
    std::filesystem::create_directories(run.out);
    (void)run_touch_recorded(run);
    return text_of(run.out / "touch.csv") + text_of(run.out / "touch.mcap");
  };
  const std::string first = trace("first", 3);
  EXPECT_GT(first.size(), 1000000U);
  EXPECT_TRUE(trace("again", 3) == first);
  EXPECT_FALSE(trace("other", 4) == first);
}

TEST_F(MujocoArmTest, TheHashOfTheConfigurationContainsTheModel) {
  const auto hash = [](const std::string& file) {
    return config_hash(configured({"robot.mjcf=" + file}).config);
  };
  const std::string file = scene("mass=\"8\"", "mass=\"8\""), before = hash(file);
  EXPECT_EQ(hash(file), before);
  scene("mass=\"8\"", "mass=\"9\"");  // of a link, in the included file
  EXPECT_NE(hash(file), before);
}

// The truth against Newton's law for the plate and against the sensor, which is another computation of MuJoCo.
TEST_F(MujocoArmTest, TheTruthIsThatOfTheContactAndTheSensorSeesIt) {
  const SlaveConfig config = slave({"sensing.force_noise_n=0", "sensing.moment_noise_nm=0"});
  MujocoArm arm(config, Random(1));
  JointVector q = start_joints(config.robot);
  const Kinematics kinematics(config.robot);
  const Vector3 start_m = arm.start_pose().p;
  EXPECT_LT((start_m - Vector3(0.409, 0.0, 0.539)).norm(), 1e-3) << "as wall.xml says";
  Time now{};
  RobotState state = arm.read(now);
  EXPECT_EQ(arm.true_penetration_m(), 0.0);
  EXPECT_EQ(arm.material_stiffness(start_m), 0.0);
  EXPECT_TRUE(arm.touched().empty());
  for (int i = 0; i < 4000; ++i) {
    // 32 mm along x within 2 s: 2 mm behind the surface.
    const Pose goal{start_m + Vector3(0.032 * std::min(1.0, i / 2000.0), 0, 0), arm.start_pose().q};
    const ToolKinematics at = kinematics.forward_with_jacobian(q);
    Eigen::Matrix<double, 6, 1> off;
    off << Vector3::Zero(), goal.p - at.X_WE.p;
    off.head<3>() = log_rotation(goal.q * at.X_WE.q.conjugate());
    q += at.J.colPivHouseholderQr().solve(off);
    arm.write(q);
    state = arm.read(now += std::chrono::milliseconds(1));
  }
  // The plate is at 0.454 m, with half a thickness of 5 mm; the tip has a radius of 10 mm.
  const double deflection_m = arm.true_pose().p.x() - (0.454 - 0.005 - 0.01);
  ASSERT_GT(deflection_m, 5e-4);
  const Vector3 force_n = arm.true_wrench().force;
  EXPECT_NEAR(-force_n.x(), kWall_n_per_m * deflection_m, 0.02 * kWall_n_per_m * deflection_m);
  EXPECT_LT((state.F_F_W.force - force_n).norm(), 1e-3 * force_n.norm());
  EXPECT_NEAR(arm.material_stiffness(arm.true_pose().p), kWall_n_per_m, 0.01 * kWall_n_per_m);
  ASSERT_EQ(arm.touched().size(), 1U);
  EXPECT_EQ(arm.touched()[0].name, "wall");
  EXPECT_NEAR(arm.touched()[0].force_n, force_n.norm(), 1e-12);
  // Without a setpoint, it stays; a setpoint that is not finite is ignored.
  q[0] = NAN;
  arm.write(q);
  EXPECT_EQ(arm.rejected_setpoints(), 1U);
  EXPECT_FALSE(arm.watchdog_stopped());
  const Vector3 at_m = arm.true_pose().p;
  for (int i = 0; i < 1000; ++i) state = arm.read(now += std::chrono::milliseconds(1));
  EXPECT_TRUE(arm.watchdog_stopped());
  EXPECT_LT((arm.true_pose().p - at_m).norm(), 5e-3);
}

TEST_F(MujocoArmTest, UnsuitableFilesAreRefusedWithFileAndName) {
  const auto refuses = [&](const std::string& file, const std::string& words,
                           const std::vector<std::string>& more = {}) {
    std::vector<std::string> settings{"robot.mjcf=" + file};
    settings.insert(settings.end(), more.begin(), more.end());
    const std::string said = error_of(settings);
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_TRUE(!more.empty() || said.find(file) != std::string::npos) << said;
    EXPECT_THROW((void)configured(settings), ConfigError) << words;
  };
  refuses("/none.xml", "there is no such file");
  refuses(scene("name=\"finger\"", "nane=\"finger\""), ": XML Error");
  refuses(scene("<site name=\"tool\"", "<site name=\"hand\""),
          "a sensor names a site or another object that the file does not have");
  refuses(scene("name=\"elbow\" axis", "name=\"elbow\" limited=\"false\" axis"),
          "the joint elbow has no range");
  const std::string plain = scene("timestep=\"0.0002\"", "timestep=\"0.0002\"");
  refuses(plain, "describes another arm than " + plain, {"robot.joint.elbow.a_m=0.1"});
  refuses(plain, "describes another arm than " + plain, {"robot_file=robots/puma560.txtpb"});
  refuses(plain, "the joint elbow has the range -2.800000 to 2.800000, but robot.joint.2 permits",
          {"robot.joint.elbow.max_rad=2.9"});
  refuses(plain, "does not divide the period of 0.001250 s (loop.rate_hz)", {"loop.rate_hz=800"});
  refuses(plain, "so robot.servo_hz must be above 0", {"robot.servo_hz=0"});
  refuses(plain, "scene_file has no effect, because robot.mjcf is set", {"scene_file=scenes/free.txtpb"});
  refuses(plain, "scene.tool_radius_m has no effect", {"scene.tool_radius_m=0.01"});
  refuses(plain, "robot.joint.0.stiffness_nm_per_rad has no effect",
          {"robot.joint.0.stiffness_nm_per_rad=1e4"});
  std::string actuators = "<actuator>";
  for (const char* joint : {"base_yaw", "shoulder", "elbow", "forearm_roll", "wrist_pitch", "wrist_roll"})
    actuators += std::string("<position joint=\"") + joint + "\" kp=\"4000\"/>";
  const std::string moved = scene("<sensor>", actuators + "</actuator><sensor>");
  EXPECT_EQ(error_of({"robot.mjcf=" + moved}), "");
  refuses(moved, "robot.servo_hz has no effect, because the position actuators of " + moved,
          {"robot.servo_hz=20"});
}

TEST_F(MujocoArmTest, ADivergingSimulationEndsTheRunWithItsName) {
  const std::string file =
      scene("</worldbody>",
            R"(<body pos="3 0 0"><joint type="slide" axis="1 0 0" limited="false" stiffness="-1e7" ref="0.1"/>
         <geom size="0.1" mass="1e-3"/></body></worldbody>)",
            R"(qpos="0 -0.4 0.8 0 -0.4 0 0")", R"(qpos="0 -0.4 0.8 0 -0.4 0 0.2 0")");
  const std::string said = error_of({"robot.mjcf=" + file});
  EXPECT_NE(said.find(file + ": the simulation diverges after"), std::string::npos) << said;
}

TEST_F(MujocoArmTest, ExperimentsWithScenesOfTheirOwnRefuseIt) {
  const std::set<std::string_view> run_with_it{"touch", "person", "unknown-contact", "drag", "docking"};
  for (const Experiment& experiment : experiments()) {
    const bool runs = uses_setting(experiment, "robot.mjcf");
    EXPECT_EQ(runs, run_with_it.contains(experiment.name)) << experiment.name;
    if (runs) continue;
    EXPECT_NE(
        unused_sentence(experiment, "robot.mjcf").find(std::string(experiment.name) + " does not run with"),
        std::string::npos);
    EXPECT_THROW(refuse_unused(experiment, {"slave.robot.mjcf=" + kScenes + "wall.xml"}), ConfigError);
  }
}

// The library and the Python package do not contain MuJoCo.
TEST_F(MujocoArmTest, AProgramWithoutMuJoCoRefusesIt) {
  const SlaveConfig config = slave({});
  const MasterConfig master = to_struct(configured({}).config.master());
  mjcf_robots = nullptr;
  EXPECT_NE(error_of({}).find("run `longreach-mujoco"), std::string::npos) << error_of({});
  EXPECT_THROW(Laboratory(master, config, 1), std::invalid_argument);
}

}  // namespace
}  // namespace longreach::mujoco_arm_test
