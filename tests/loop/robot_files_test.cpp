// The robots that ship and one that a user writes: what their files say, what is printed of them, and what
// `longreach-lab solve` answers about them.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/config/config.hpp"
#include "deploy/lab/robot/random_arm.hpp"
#include "deploy/lab/solve/solve.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::robot_files_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const fs::path kDeploy = LONGREACH_DEPLOY;

RobotConfig robot_of(const fs::path& file) {
  proto::SlaveConfig config;
  config.set_robot_file(file.string());
  resolve_files(config, kDeploy);
  return to_struct(config).robot;
}

std::vector<test::NamedArm> known_robots() {
  std::vector<test::NamedArm> known = test::ready_arms();
  known.push_back({"cartesian", test::cartesian(), test::cartesian()});
  return known;
}

void expect_same_rows(const RobotConfig& file, const RobotConfig& known, const std::string& name) {
  EXPECT_EQ(file.convention, known.convention) << name;
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    const JointConfig &a = file.joint[i], &b = known.joint[i];
    EXPECT_EQ(a.kind, b.kind) << name << " " << i;
    const std::array<double, 6> of_file{a.a_m, a.alpha_rad, a.d_m, a.theta_rad, a.min_rad, a.max_rad},
        of_known{b.a_m, b.alpha_rad, b.d_m, b.theta_rad, b.min_rad, b.max_rad};
    EXPECT_EQ(of_file, of_known) << name << " " << i;
  }
}

TEST(RobotFiles, AreThoseThatTheLawsOfTheRobotAreTestedWith) {
  std::map<std::string, RobotConfig> files;
  for (const auto& entry : fs::directory_iterator(kDeploy / "robots"))
    files[entry.path().stem().string()] = robot_of(entry.path());
  EXPECT_GT(files.size(), known_robots().size());
  for (const test::NamedArm& known : known_robots()) {
    ASSERT_TRUE(files.contains(known.name)) << known.name;
    EXPECT_EQ(files[known.name].name, known.name);
    expect_same_rows(files[known.name], known.limited, known.name);
  }
}

TEST(RobotFiles, NameClosedFormAndStartAwayFromSingularPoses) {
  const std::map<std::string, std::string> kWords{
      {"space_arm", "closed form, quadratic: axes 2-3-4 parallel"},
      {"puma560", "closed form, quadratic: axes 4-5-6 intersect"},
      {"ur10", "closed form, quadratic: axes 2-3-4 parallel"},
      {"ur5e", "closed form, quadratic: axes 2-3-4 parallel"},
      {"kr6", "closed form, quadratic: axes 4-5-6 intersect"},
      {"irb120", "closed form, quadratic: axes 4-5-6 intersect"},
      {"gantry", "no closed form: solved numerically"},
      {"cartesian", "linear: three prismatic joints, rotation ignored"}};
  for (const auto& entry : fs::directory_iterator(kDeploy / "robots")) {
    const std::string name = entry.path().stem().string();
    ASSERT_TRUE(kWords.contains(name)) << name;
    const std::string& words = kWords.at(name);
    const RobotConfig robot = robot_of(entry.path());
    const Inverse inverse(robot);
    EXPECT_EQ(inverse.words(), words);
    JointVector start;
    for (std::size_t i = 0; i < kMaxJoints; ++i) start[static_cast<int>(i)] = robot.joint[i].start_rad;
    const InverseResult result = inverse.solve(inverse.kinematics().forward(start), start, {});
    EXPECT_EQ(result.status, InverseStatus::kFound) << name;
    EXPECT_GT(result.conditioning, 0.01) << name;
  }
}

// The PUMA 560 in Craig's convention, with a tool: the rows move one joint on, the solutions stay.
TEST(RobotFiles, OneThatAUserWritesIsSolvedInClosedForm) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("mine.txtpb",
                                     "name: \"mine\" convention: MODIFIED\n"
                                     "joint { d_m: 0.6718 }\n"
                                     "joint { alpha_rad: 1.5707963267948966 }\n"
                                     "joint { a_m: 0.4318 d_m: 0.15005 }\n"
                                     "joint { a_m: 0.0203 alpha_rad: -1.5707963267948966 d_m: 0.4318 }\n"
                                     "joint { alpha_rad: 1.5707963267948966 }\n"
                                     "joint { alpha_rad: -1.5707963267948966 d_m: 0.05625 }\n"
                                     "tool { position_m: [0, 0, 0.2] }\n");
  const Inverse mine(robot_of(file));
  EXPECT_EQ(mine.words(), "closed form, quadratic: axes 4-5-6 intersect");
  RobotConfig known = test::ready_arms()[1].robot;
  known.joint[5].d_m += 0.2;
  Random random(3);
  for (int n = 0; n < 100; ++n) {
    const JointVector q = test::random_joints(random);
    const Pose goal = Inverse(known).kinematics().forward(q);
    const Pose X = mine.kinematics().forward(q);
    EXPECT_LT((X.p - goal.p).norm() + X.q.angularDistance(goal.q), 1e-14);
    EXPECT_EQ(mine.all(goal, q, {}).count, 8);
  }
}

class SolveRobot : public testing::Test {
 protected:
  void SetUp() override { setenv("LONGREACH_HOME", LONGREACH_DEPLOY, 1); }
  void TearDown() override { unsetenv("LONGREACH_HOME"); }
};

Json answer(const std::string& kind, const Json& request) {
  std::istringstream in(request.dump());
  std::ostringstream out;
  EXPECT_EQ(solve(kind, in, out), 0) << out.str();
  return Json::parse(out.str());
}

TEST_F(SolveRobot, AnswersAboutEveryRobotThatShips) {
  for (const test::NamedArm& known : test::ready_arms()) {
    const std::vector<double> q{0.2, 0.7, -1.1, 0.4, 0.6, -0.3};
    const Json forward = answer("robot-fk", {{"robot", known.name}, {"q", q}});
    const RigidKinematics tool =
        Kinematics(known.robot).rigid_with_jacobian(Eigen::Map<const JointVector>(q.data()));
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(forward["X"][i][3].get<double>(), tool.X_WE.p[static_cast<int>(i)]) << known.name;
    EXPECT_EQ(forward["J"][5][0].get<double>(), tool.J(5, 0));
    const Json inverse = answer("robot-ik", {{"robot", known.name}, {"X", forward["X"]}, {"near", q}});
    EXPECT_EQ(inverse["status"], "FOUND");
    EXPECT_GE(inverse["solutions"].size(), 4u);
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(inverse["nearest"][i].get<double>(), q[i], 1e-12) << known.name;
    EXPECT_LE(inverse["position_error"].get<double>(), 1e-13);
    EXPECT_LE(inverse["rotation_error"].get<double>(), 1e-14);
  }
}

// Rows in place; the same as the file says.
TEST_F(SolveRobot, TakesRowsInPlace) {
  Json rows = Json::array();
  const RobotConfig ur10 = test::ready_arms()[2].robot;
  for (const JointConfig& j : ur10.joint)
    rows.push_back({{"a", j.a_m}, {"alpha", j.alpha_rad}, {"d", j.d_m}, {"theta", j.theta_rad}});
  const Json q = {0.1, -1.0, 1.2, 0.3, 0.8, -2.0};
  EXPECT_EQ(answer("robot-fk", {{"dh", rows}, {"q", q}}), answer("robot-fk", {{"robot", "ur10"}, {"q", q}}));
  EXPECT_NE(answer("robot-fk", {{"dh", rows}, {"convention", "modified"}, {"q", q}}),
            answer("robot-fk", {{"robot", "ur10"}, {"q", q}}));
}

TEST_F(SolveRobot, TakesAFileByItsPathFromTheWorkingFolder) {
  const std::filesystem::path before = std::filesystem::current_path();
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "longreach_solve_robot";
  std::filesystem::create_directories(folder / "mine");
  std::filesystem::copy_file(std::filesystem::path(LONGREACH_DEPLOY) / "robots/ur10.txtpb",
                             folder / "mine/arm.txtpb", std::filesystem::copy_options::overwrite_existing);
  std::filesystem::current_path(folder);
  const Json q = {0.1, -1.0, 1.2, 0.3, 0.8, -2.0};
  EXPECT_EQ(answer("robot-fk", {{"robot", "mine/arm.txtpb"}, {"q", q}}),
            answer("robot-fk", {{"robot", "ur10"}, {"q", q}}));
  std::filesystem::current_path(before);
  std::filesystem::remove_all(folder);
}

TEST_F(SolveRobot, SaysWhatIsWrongWithAQuestion) {
  const auto error = [](const std::string& kind, const std::string& line) {
    std::istringstream in(line);
    std::ostringstream out;
    EXPECT_EQ(solve(kind, in, out), 1) << line;
    return Json::parse(out.str())["error"].get<std::string>();
  };
  const auto says = [&](const std::string& kind, const std::string& line, const std::string& words) {
    const std::string said = error(kind, line);
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  says("robot-fk", R"({"robot": "ur1", "q": [0,0,0,0,0,0]})", "; did you mean \"ur10\"?");
  says("robot-fk", R"({"robot": "none.txtpb", "q": [0,0,0,0,0,0]})", "the file does not exist in ");
  says(
      "robot-fk",
      R"({"dh": [{"a":0,"d":0,"alpha":90},{"a":1,"d":0,"alpha":0},{"a":1,"d":0,"alpha":0},{"a":0,"d":0,"alpha":0},{"a":0,"d":0,"alpha":0},{"a":0,"d":0,"alpha":0}], "q": [0,0,0,0,0,0]})",
      "\"alpha\" = 90 in a row of \"dh\" is outside -3.2 to 3.2; the unit is rad, but this value "
      "seems to be in degrees");
  says("robot-ik", R"({"robot": "ur10", "X": [[1,0,0,0],[0,1,0,0],[0,0,1.01,0],[0,0,0,1]]})",
       "R R^T differs from the identity by 0.02");
  says("robot-ik", R"({"robot": "ur10", "X": [[1,0,0,0],[0,1,0,0],[0,0,-1,0],[0,0,0,1]]})", "a reflection");
  says("robot-fk", R"({"robot": "ur10", "q": [0,90,0,0,0,0]})",
       "\"q\" = 90 is more than two turns of a joint; the unit is rad, but this value seems to be in "
       "degrees");
  EXPECT_EQ(error("robot-fk", R"({"robot": "ur10", "q": [0,0,0]})"), "\"q\" must be a list of six numbers");
  EXPECT_EQ(error("robot-fk", R"({"dh": [], "q": [0,0,0,0,0,0]})"),
            "\"dh\" must be a list of six rows, not 0");
  EXPECT_EQ(error("robot-ik", R"({"robot": "ur10", "X": [[1,0,0,0]]})"), "\"X\" must be a list of four rows");
}

}  // namespace
}  // namespace longreach::robot_files_test
