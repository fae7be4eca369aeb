// Elements of URDF 1.0 to 1.2, in and out of the arm's chain: 50 files are read as urdfdom 3.0.1 and MuJoCo 2.2.2 read
// them, where these know the element. Neither knows quat_xyzw, acceleration, deceleration and jerk: there the same arm
// written with rpy, or with settings, is the reference. What is not supported is refused with a sentence or named.

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "common/config/config.hpp"
#include "common/config/robot/urdf.hpp"
#include "common/core/random.hpp"
#include "common/text/number_text.hpp"
#include "slave/kinematics/kinematics.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::urdf_elements_test {
namespace {

const std::string kLimit = "<limit lower='-2' upper='2.5' velocity='3' effort='10'/>";

/// One file: the base arm with changes.
struct File {
  std::string robot = "<robot name='arm'>";
  std::array<std::string, 6> type{"revolute", "revolute", "revolute", "revolute", "revolute", "revolute"};
  std::array<std::string, 6> origin{"<origin xyz='0 0 0.3'/>",  "<origin xyz='0.05 0 0.1'/>",
                                    "<origin xyz='0 0 0.5'/>",  "<origin xyz='0.2 0 0.02'/>",
                                    "<origin xyz='0.25 0 0'/>", "<origin xyz='0.08 0 0'/>"};
  std::array<std::string, 6> axis{"<axis xyz='0 0 1'/>", "<axis xyz='0 1 0'/>", "<axis xyz='0 1 0'/>",
                                  "<axis xyz='1 0 0'/>", "<axis xyz='0 1 0'/>", "<axis xyz='1 0 0'/>"};
  std::array<std::string, 6> inside{kLimit, kLimit, kLimit, kLimit, kLimit, kLimit};
  std::string mount = "<origin xyz='0.1 0.02 0' rpy='0.1 1.2 -0.4'/>";
  std::string before{}, behind{};  // in front of and behind the joints
  bool links_last = false;

  [[nodiscard]] std::string text() const {
    std::string links, joints;
    for (int i = 0; i <= 7; ++i)
      links +=
          "<link name='" + link(i) +
          "'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>"
          "</link>\n";
    for (int i = 0; i < 6; ++i) {
      const auto n = static_cast<std::size_t>(i);
      joints += "<joint name='j" + std::to_string(i + 1) + "' type='" + type[n] + "'><parent link='" +
                link(i) + "'/><child link='" + link(i + 1) + "'/>" + origin[n] + axis[n] + inside[n] +
                "</joint>\n";
    }
    joints += "<joint name='mount' type='fixed'><parent link='" + link(6) + "'/><child link='tip'/>" + mount +
              "</joint>\n";
    return robot + "<mujoco><compiler fusestatic='false' balanceinertia='true'/></mujoco>\n" + before +
           (links_last ? joints + links : links + joints) + behind + "</robot>\n";
  }
  static std::string link(int i) { return i == 7 ? "tip" : "l" + std::to_string(i); }
};

struct Case {
  std::string name;
  File file;
  bool urdfdom = true, mujoco = true;  // whether these know the element
};

template <class Change>
Case made(const std::string& name, const Change& change, bool urdfdom = true, bool mujoco = true) {
  Case one{name, {}, urdfdom, mujoco};
  change(one.file);
  return one;
}

/// A side branch: a link on the last moving link, with the given joint.
std::string finger(const std::string& type, const std::string& inside) {
  return "<link name='finger'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
         "</inertial></link><joint name='finger_joint' type='" +
         type + "'><parent link='l6'/><child link='finger'/><origin xyz='0 0.1 0'/>" + inside + "</joint>";
}

std::vector<Case> cases() {
  std::vector<Case> all;
  const auto add = [&](const std::string& name, const auto& change, bool urdfdom = true, bool mujoco = true) {
    all.push_back(made(name, change, urdfdom, mujoco));
  };
  add("plain", [](File&) {});
  add("version 1.0", [](File& f) { f.robot = "<robot name='arm' version='1.0'>"; });
  add(
      "version 1.1", [](File& f) { f.robot = "<robot name='arm' version='1.1'>"; }, false);
  add(
      "version 1.2", [](File& f) { f.robot = "<robot name='arm' version='1.2'>"; }, false);
  add("namespace", [](File& f) { f.robot = "<robot name='arm' xmlns:xacro='http://x'>"; });
  add("declaration", [](File& f) { f.robot = "<?xml version='1.0'?>" + f.robot; });
  add(
      "comment before declaration", [](File& f) { f.robot = "<!-- a -->\n<?xml version='1.0'?>" + f.robot; },
      false, false);
  add("no xyz", [](File& f) { f.origin[2] = "<origin rpy='0.3 0 0'/>"; });
  add("rpy", [](File& f) { f.origin[2] = "<origin xyz='0 0 0.5' rpy='0.3 -0.2 1.1'/>"; });
  add("rpy beyond a turn", [](File& f) { f.origin[1] = "<origin xyz='0.1 0 0' rpy='7 0 -8'/>"; });
  add("rpy at gimbal lock",
      [](File& f) { f.origin[1] = "<origin xyz='0.1 0 0' rpy='0.4 1.5707963267948966 0.2'/>"; });
  add("no origin", [](File& f) { f.origin[5] = ""; });
  add("empty origin", [](File& f) { f.origin[5] = "<origin/>"; });
  add("no axis", [](File& f) { f.axis[3] = ""; });
  add("axis of another length", [](File& f) { f.axis[1] = "<axis xyz='0 5 0'/>"; });
  add("rotation without position", [](File& f) { f.origin[4] = "<origin rpy='0.3 -0.2 0.1'/>"; });
  add("position without rotation", [](File& f) { f.origin[4] = "<origin xyz='0.01 -0.02 1'/>"; });
  add("rotations beyond a turn", [](File& f) { f.origin[4] = "<origin xyz='0 0 0' rpy='7 -9 -13'/>"; });
  add("attributes in another order",
      [](File& f) { f.origin[4] = "<origin rpy='0.3 0.2 0.1' xyz='0.01 0.02 0.03'></origin>"; });
  add("oblique axis of a turned joint", [](File& f) {
    f.origin[4] = "<origin xyz='0.1 0 0' rpy='1 2 3'/>";
    f.axis[4] = "<axis xyz='-1 2 3'/>";
  });
  add("negative axis", [](File& f) { f.axis[1] = "<axis xyz='0 -1 0'/>"; });
  add("oblique axis", [](File& f) { f.axis[3] = "<axis xyz='0.8 0.1 -0.6'/>"; });
  add("scientific numbers", [](File& f) { f.origin[2] = "<origin xyz='0 1e-2 5.0E-1'/>"; });
  add("continuous", [](File& f) {
    f.type[3] = "continuous";
    f.inside[3] = "<limit velocity='3' effort='10'/>";
  });
  add("prismatic", [](File& f) {
    f.type[2] = "prismatic";
    f.inside[2] = "<limit lower='0' upper='0.5' velocity='1' effort='9'/>";
  });
  return all;
}

/// Elements beside the arm's chain, and elements without influence on it.
std::vector<Case> other_cases() {
  std::vector<Case> all;
  const auto add = [&](const std::string& name, const auto& change, bool urdfdom = true, bool mujoco = true) {
    all.push_back(made(name, change, urdfdom, mujoco));
  };
  add("turned mount", [](File& f) { f.mount = "<origin xyz='0 0 0.1' rpy='1 2 3'/>"; });
  add("links behind joints", [](File& f) { f.links_last = true; });
  add("fixed side branch", [](File& f) { f.behind = finger("fixed", ""); });
  add(
      "moving side branch", [](File& f) { f.behind = finger("revolute", kLimit); }, true, false);
  add(
      "mimic in a side branch",
      [](File& f) { f.behind = finger("revolute", kLimit + "<mimic joint='j6' multiplier='2'/>"); }, true,
      false);
  add(
      "floating side branch", [](File& f) { f.behind = finger("floating", ""); }, true, false);
  add("dynamics", [](File& f) { f.inside[1] += "<dynamics damping='0.5' friction='0.1'/>"; });
  add("calibration", [](File& f) { f.inside[1] += "<calibration rising='0.1'/>"; });
  add("effort only",
      [](File& f) { f.inside[1] = "<limit effort='1e3' velocity='3' upper='2.5' lower='-2'/>"; });
  add("visual", [](File& f) { f.before = "<material name='grey'><color rgba='1 1 1 1'/></material>"; });
  add("transmission", [](File& f) {
    f.behind =
        "<transmission name='t'><type>x</type><joint name='j1'><hardwareInterface>p</hardwareInterface></joint><actuator name='m'><mechanicalReduction>50</mechanicalReduction></actuator></transmission>";
  });
  add("gazebo", [](File& f) {
    f.behind = "<gazebo reference='j1'><implicitSpringDamper>1</implicitSpringDamper></gazebo>";
  });
  add("ros2_control",
      [](File& f) { f.behind = "<ros2_control name='r' type='system'><joint name='j1'/></ros2_control>"; });
  // urdfdom 3.0.1 refuses an origin with a tab, which XML treats as a space.
  add(
      "tabs and line ends", [](File& f) { f.origin[2] = "<origin xyz='0\t0.01\n  0.5 '/>"; }, false, true);
  add("text and comments", [](File& f) { f.behind = "<!-- <joint name='j1'/> -->"; });
  return all;
}

RobotConfig config_of(const proto::Robot& robot) {
  proto::SlaveConfig config;
  *config.mutable_robot() = robot;
  return to_struct(config).robot;
}

proto::Robot read(const File& file, std::vector<std::string>* ignored = nullptr) {
  proto::Robot wanted;
  wanted.set_tip_link("tip");
  return read_urdf("arm.urdf", file.text(), wanted, ignored);
}

Pose pose_of(const urdf::Pose& X) {
  return {{X.position.x, X.position.y, X.position.z},
          {X.rotation.w, X.rotation.x, X.rotation.y, X.rotation.z}};
}

/// The chain from the root to `tip` in the model of urdfdom.
std::vector<urdf::JointConstSharedPtr> chain_of(const urdf::ModelInterfaceSharedPtr& model) {
  std::vector<urdf::JointConstSharedPtr> chain;
  for (urdf::LinkConstSharedPtr link = model->getLink("tip"); link->parent_joint; link = link->getParent())
    chain.insert(chain.begin(), link->parent_joint);
  return chain;
}

Pose forward(const std::vector<urdf::JointConstSharedPtr>& chain, const JointVector& q) {
  Pose X;
  int moving = 0;
  for (const auto& joint : chain) {
    X = X * pose_of(joint->parent_to_joint_origin_transform);
    if (joint->type == urdf::Joint::FIXED) continue;
    const Vector3 axis = Vector3(joint->axis.x, joint->axis.y, joint->axis.z).normalized();
    X = X * (joint->type == urdf::Joint::PRISMATIC ? Pose{q[moving] * axis, Quaternion::Identity()}
                                                   : Pose{Vector3::Zero(), exp_rotation(q[moving] * axis)});
    ++moving;
  }
  return X;
}

Pose forward_mujoco(const mjModel* model, mjData* data, const JointVector& q) {
  const int tip = mj_name2id(model, mjOBJ_BODY, "tip");
  std::copy(q.begin(), q.end(), data->qpos);
  mj_kinematics(model, data);
  const mjtNum *p = data->xpos + 3 * tip, *r = data->xquat + 4 * tip;
  return {{p[0], p[1], p[2]}, {r[0], r[1], r[2], r[3]}};
}

double apart(const Pose& a, const Pose& b) {
  return std::max((a.p - b.p).norm(), (a.q.toRotationMatrix() - b.q.toRotationMatrix()).norm());
}

std::vector<JointVector> drawn() {
  Random random(7);
  std::vector<JointVector> all(20);
  for (JointVector& q : all)
    for (double& value : q) value = 4.0 * random.uniform() - 2.0;
  return all;
}

// Positions, limits and speeds of every joint.
TEST(UrdfElements, AreReadAsUrdfdomAndMujocoReadThem) {
  std::vector<Case> all = cases();
  std::ranges::move(other_cases(), std::back_inserter(all));
  ASSERT_GE(all.size(), 40u);
  for (const Case& one : all) {
    SCOPED_TRACE(one.name);
    const RobotConfig robot = config_of(read(one.file));
    const Kinematics ours(robot);
    if (one.urdfdom) {
      const auto model = urdf::parseURDF(one.file.text());
      ASSERT_TRUE(model);
      const auto chain = chain_of(model);
      for (const JointVector& q : drawn()) EXPECT_LT(apart(ours.forward(q), forward(chain, q)), 1e-12);
      std::size_t i = 0;
      for (const auto& joint : chain) {
        if (joint->type == urdf::Joint::FIXED) continue;
        EXPECT_EQ(robot.joint[i].speed_max_rad_per_s, joint->limits->velocity);
        if (joint->type != urdf::Joint::CONTINUOUS) {
          EXPECT_EQ(robot.joint[i].min_rad, joint->limits->lower);
          EXPECT_EQ(robot.joint[i].max_rad, joint->limits->upper);
        }
        ++i;
      }
      EXPECT_EQ(i, 6u);
    }
    if (one.mujoco) {
      const TemporaryFolder folder;
      char error[300] = "";
      const std::unique_ptr<mjModel, void (*)(mjModel*)> model(
          mj_loadXML(folder.write("arm.urdf", one.file.text()).c_str(), nullptr, error, sizeof error),
          mj_deleteModel);
      ASSERT_TRUE(model) << error;
      ASSERT_EQ(model->nq, 6);
      const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(model.get()), mj_deleteData);
      for (const JointVector& q : drawn())
        EXPECT_LT(apart(ours.forward(q), forward_mujoco(model.get(), data.get(), q)), 1e-12);
    }
  }
}

// The reference is the same arm with rpy.
TEST(UrdfElements, QuaternionEqualsTheSameRotationByRpy) {
  Random random(3);
  for (int n = 0; n < 20; ++n) {
    const Vector3 rpy(6.0 * random.uniform() - 3.0, 3.0 * random.uniform() - 1.5,
                      6.0 * random.uniform() - 3.0);
    const Quaternion q(Eigen::AngleAxisd(rpy.z(), Vector3::UnitZ()) *
                       Eigen::AngleAxisd(rpy.y(), Vector3::UnitY()) *
                       Eigen::AngleAxisd(rpy.x(), Vector3::UnitX()));
    File by_rpy, by_quaternion;
    const auto three = [](const Vector3& v) {
      return format_number(v.x()) + " " + format_number(v.y()) + " " + format_number(v.z());
    };
    by_rpy.mount = "<origin xyz='0.1 0 0.2' rpy='" + three(rpy) + "'/>";
    by_quaternion.mount =
        "<origin xyz='0.1 0 0.2' quat_xyzw='" + three(q.vec()) + " " + format_number(q.w()) + "'/>";
    by_rpy.origin[2] = "<origin xyz='0 0 0.5' rpy='" + three(rpy) + "'/>";
    by_quaternion.origin[2] =
        "<origin xyz='0 0 0.5' quat_xyzw='" + three(q.vec()) + " " + format_number(q.w()) + "'/>";
    const Kinematics a(config_of(read(by_rpy))), b(config_of(read(by_quaternion)));
    for (const JointVector& joints : drawn()) EXPECT_LT(apart(a.forward(joints), b.forward(joints)), 1e-9);
  }
}

// The reference is the same arm with these limits as settings.
TEST(UrdfElements, LimitsOfUrdf12EqualTheSameSettings) {
  File file;
  file.inside.fill(
      "<limit lower='-2' upper='2.5' velocity='3' effort='10' acceleration='1.5' deceleration='1.25' jerk='20'/>");
  file.inside[3] = "<limit lower='-2' upper='2.5' velocity='3' effort='10' deceleration='0.75'/>";
  file.inside[4] = "<limit lower='-2' upper='2.5' velocity='3' effort='10' acceleration='inf' jerk='inf'/>";
  file.inside[5] =
      kLimit +
      "<safety_controller soft_lower_limit='-1.5' soft_upper_limit='3' k_position='1' k_velocity='1'/>";
  const RobotConfig robot = config_of(read(file));
  proto::Robot set = read({});
  for (int i = 0; i < 3; ++i) {
    set_field(set, "joint." + std::to_string(i) + ".acceleration_max_rad_per_s2", "1.25");
    set_field(set, "joint." + std::to_string(i) + ".jerk_max_rad_per_s3", "20");
  }
  set_field(set, "joint.3.acceleration_max_rad_per_s2", "0.75");
  set_field(set, "joint.5.min_rad", "-1.5");
  const RobotConfig expected = config_of(set);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(robot.joint[i].acceleration_max_rad_per_s2, expected.joint[i].acceleration_max_rad_per_s2) << i;
    EXPECT_EQ(robot.joint[i].jerk_max_rad_per_s3, expected.joint[i].jerk_max_rad_per_s3) << i;
    EXPECT_EQ(robot.joint[i].min_rad, expected.joint[i].min_rad) << i;
    EXPECT_EQ(robot.joint[i].max_rad, expected.joint[i].max_rad) << i;
  }
}

TEST(UrdfElements, InfiniteLimitsOfARevoluteJointAreTwoTurns) {
  File file;
  file.inside[5] = "<limit lower='-inf' upper='inf' velocity='3' effort='10'/>";
  const RobotConfig robot = config_of(read(file));
  EXPECT_NEAR(robot.joint[5].min_rad, -12.566370614359172, 1e-12);
  EXPECT_NEAR(robot.joint[5].max_rad, 12.566370614359172, 1e-12);
}

TEST(UrdfElements, AreRefusedWithASentence) {
  const std::vector<std::pair<std::string, Case>> refused{
      {"follows another joint (<mimic>)", made("", [](File& f) { f.inside[2] += "<mimic joint='j1'/>"; })},
      {"has the type \"floating\"", made("", [](File& f) { f.type[2] = "floating"; })},
      {"has the type \"planar\"", made("", [](File& f) { f.type[2] = "planar"; })},
      {"which has no direction", made("", [](File& f) { f.axis[2] = "<axis xyz='0 0 0'/>"; })},
      {"has more than one <origin>", made("", [](File& f) { f.origin[2] += "<origin xyz='1 0 0'/>"; })},
      {"has more than one <axis>", made("", [](File& f) { f.axis[2] += "<axis xyz='1 0 0'/>"; })},
      {"has rpy and quat_xyzw",
       made("", [](File& f) { f.mount = "<origin rpy='0 0 0' quat_xyzw='0 0 0 1'/>"; })},
      {"with 3 numbers; four are required",
       made("", [](File& f) { f.mount = "<origin quat_xyzw='0 0 1'/>"; })},
      {"a rotation has the length 1", made("", [](File& f) { f.mount = "<origin quat_xyzw='0 0 1 1'/>"; })},
      {"acceleration=\"-1\"; it must be above 0",
       made("",
            [](File& f) { f.inside[2] = "<limit lower='-2' upper='2' velocity='3' acceleration='-1'/>"; })},
      {"has no <limit>", made("", [](File& f) { f.inside[2] = ""; })},
      {"is not a finite number", made("", [](File& f) { f.origin[2] = "<origin xyz='0 0 nan'/>"; })},
      {"lower must be below upper",
       made("", [](File& f) { f.inside[2] = "<limit lower='2' upper='-2' velocity='3'/>"; })},
      {"slides without a limit", made("",
                                      [](File& f) {
                                        f.type[2] = "prismatic";
                                        f.inside[2] = "<limit lower='-inf' upper='inf' velocity='3'/>";
                                      })},
      {"soft_lower_limit must be below",
       made(
           "",
           [](File& f) { f.inside[2] += "<safety_controller soft_lower_limit='5' soft_upper_limit='6'/>"; })},
  };
  for (const auto& [sentence, one] : refused) {
    try {
      (void)read(one.file);
      ADD_FAILURE() << sentence;
    } catch (const ConfigError& error) {
      EXPECT_NE(std::string(error.what()).find(sentence), std::string::npos) << error.what();
    }
  }
}

TEST(UrdfElements, NameWhatIsIgnoredOncePerKind) {
  File file;
  file.inside.fill(kLimit + "<dynamics damping='1'/>");
  file.inside[1] += "<calibration rising='0'/><spring k='3'/>";
  file.behind = "<transmission name='t'/><transmission name='u'/>";
  std::vector<std::string> ignored;
  (void)read(file, &ignored);
  std::string all;
  for (const std::string& sentence : ignored) all += sentence.substr(sentence.find("ignored")) + "\n";
  EXPECT_EQ(
      all,
      "ignored: effort of <limit> (6 times); longreach limits motion, not the torque of joints\n"
      "ignored: <dynamics> (6 times); use damping_nm_s_per_rad and friction_nm of the joints in robot\n"
      "ignored: <calibration>; the robot's controller finds its reference positions\n"
      "ignored: <spring>; it is not part of URDF 1.0 to 1.2\n"
      "ignored: <mujoco>; it is for another simulator\n"
      "ignored: <transmission> (2 times); joint positions are those of the joints, not of the motors\n");
}

}  // namespace
}  // namespace longreach::urdf_elements_test
