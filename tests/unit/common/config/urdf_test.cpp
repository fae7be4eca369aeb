// URDF files: what is read, and with which words a broken one is refused.

#include "common/config/robot/urdf.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/config/config.hpp"

namespace longreach::urdf_test {
namespace {

std::string joint(
    const std::string& name, const std::string& parent, const std::string& child,
    const std::string& inside = "<axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\" velocity=\"2\"/>",
    const std::string& type = "revolute") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/><origin xyz=\"0.1 0 0.2\" rpy=\"1.5 0 0\"/>" + inside +
         "</joint>\n";
}

std::string link(const std::string& name) { return "<link name=\"" + name + "\"/>\n"; }

/// Line 1: <robot>; 2 to 8: links 0 to 6; 9 to 14: joints a to f, and `more` from line 15.
struct File {
  std::vector<std::string> joints;
  std::string more{};
  File() {
    for (int i = 0; i < 6; ++i)
      joints.push_back(
          joint(std::string(1, static_cast<char>('a' + i)), std::to_string(i), std::to_string(i + 1)));
  }
  [[nodiscard]] std::string text() const {
    std::string text = "<robot name=\"arm\">\n";
    for (int i = 0; i <= 6; ++i) text += link(std::to_string(i));
    for (const std::string& j : joints) text += j;
    return text + more + "</robot>\n";
  }
};

std::string refusal(const std::string& text, const proto::Robot& wanted = {}) {
  try {
    (void)read_urdf("arm.urdf", text, wanted);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "not refused";
}

#define EXPECT_SAYS(said, words) EXPECT_NE((said).find(words), std::string::npos) << (said)

TEST(Urdf, BecomesARobotWithTheNamesAndLimitsOfItsFile) {
  const proto::Robot robot = read_urdf("arms/arm.urdf", File().text(), {});
  EXPECT_EQ(robot.name(), "arm");
  EXPECT_EQ(robot.basis(), "URDF arm.urdf, 0 to 6");
  ASSERT_EQ(robot.joint_size(), 6);
  EXPECT_EQ(robot.joint(2).name(), "c");
  EXPECT_EQ(robot.joint(2).min_rad(), -1.0);
  EXPECT_EQ(robot.joint(2).speed_max_rad_per_s(), 2.0);
  EXPECT_FALSE(robot.joint(2).has_acceleration_max_rad_per_s2()) << "the default applies";
  EXPECT_FALSE(robot.joint(2).has_jerk_max_rad_per_s3());
}

TEST(Urdf, FindsTheArmInATree) {
  File file;
  file.more = link("finger") + joint("finger_joint", "6", "finger", "<mimic joint=\"a\"/>", "prismatic") +
              link("camera") + joint("camera_joint", "3", "camera", "", "fixed");
  const std::string said = refusal(file.text());
  EXPECT_SAYS(said, "no end link has 6 moving joints before it; name the tool in robot.tip_link: 6 has 6");
  proto::Robot wanted;
  wanted.set_tip_link("6");
  EXPECT_EQ(read_urdf("arm.urdf", file.text(), wanted).tip_link(), "6")
      << "a joint that follows is not in the chain";
  file.more += link("tool") + joint("tool_joint", "6", "tool", "", "fixed");
  EXPECT_EQ(read_urdf("arm.urdf", file.text(), {}).tip_link(), "tool") << "the only end behind six";
  file.more += link("other") + joint("other_joint", "6", "other", "", "fixed");
  EXPECT_SAYS(refusal(file.text()), "2 end links have 6 moving joints before them (other, tool)");
}

TEST(Urdf, ContinuousJointsAndWideLimitsMayTurnTwiceEitherWay) {
  File file;
  file.joints[3] = joint("d", "3", "4", "<limit velocity=\"2\"/>", "continuous");
  file.joints[4] =
      joint("e", "4", "5", "<axis xyz=\"0 1 0\"/><limit lower=\"-1e3\" upper=\"30\" velocity=\"2\"/>");
  const proto::Robot robot = read_urdf("arm.urdf", file.text(), {});
  for (const int i : {3, 4}) {
    EXPECT_NEAR(robot.joint(i).min_rad(), -12.566, 1e-3);
    EXPECT_NEAR(robot.joint(i).max_rad(), 12.566, 1e-3);
  }
}

TEST(Urdf, StartsWithinTheLimitsAndAwayFromSingularPoses) {
  File file;
  file.joints[1] =
      joint("b", "1", "2", "<axis xyz=\"0 1 0\"/><limit lower=\"0.5\" upper=\"1.5\" velocity=\"2\"/>");
  const proto::Robot robot = read_urdf("arm.urdf", file.text(), {});
  EXPECT_GT(robot.joint(1).start_rad(), 0.7);
  EXPECT_LT(robot.joint(1).start_rad(), 1.3);
}

struct Broken {
  std::string words;
  std::string text;
};

std::vector<Broken> broken_files() {
  std::vector<Broken> all;
  const auto with = [&](std::size_t i, const std::string& text, const std::string& words) {
    File file;
    file.joints[i] = text;
    all.push_back({words, file.text()});
  };
  const auto inside = [&](const std::string& text, const std::string& words,
                          const std::string& type = "revolute") {
    with(2, joint("c", "2", "3", text, type), words);
  };
  all.push_back({"arm.urdf:1: the file is empty", ""});
  all.push_back(
      {"arm.urdf:2: this is not well-formed XML", "<robot name=\"a\">\n<link name=\"b\">\n</robot>"});
  all.push_back({"arm.urdf:1: the root is <sdf>; a URDF begins with <robot>", "<sdf version=\"1\"/>"});
  all.push_back(
      {"arm.urdf:2: <xacro:include> belongs to xacro", "<robot>\n<xacro:include filename=\"a\"/></robot>"});
  inside("<axis xyz=\"0 0 ${z}\"/>", "arm.urdf:11: xyz=\"0 0 ${z}\" belongs to xacro");
  all.push_back({"arm.urdf:1: <robot> has no <link>", "<robot name=\"a\"/>"});
  File twice;
  twice.more = link("3");
  all.push_back({"arm.urdf:15: link \"3\" is already defined on line 5", twice.text()});
  with(5, joint("a", "5", "6"), "arm.urdf:14: joint \"a\" is already defined on line 9");
  with(5, joint("f", "5", "7"),
       "arm.urdf:14: joint \"f\" has the child link \"7\", which is not in the file");
  File closed;
  closed.more = joint("g", "2", "6");
  all.push_back(
      {"arm.urdf:15: link \"6\" is the child of two joints, \"f\" and \"g\"; closed chains are not supported",
       closed.text()});
  with(0, joint("a", "6", "1"), "no link has 6 moving joints between itself and \"0\"; the maximum is 0");
  with(5, joint("f", "5", "6", "", "fixed"), "the maximum is 5, and longreach needs an arm with 6");
  inside("<axis xyz=\"0 0 0\"/><limit lower=\"-1\" upper=\"1\" velocity=\"2\"/>",
         "arm.urdf:11: joint \"c\" has the axis \"0 0 0\", which has no direction");
  inside("<axis xyz=\"0 nan 1\"/>",
         "arm.urdf:11: <axis> has xyz=\"0 nan 1\"; \"nan\" is not a finite number");
  inside("<axis xyz=\"0 1\"/>", "with 2 numbers; three are required");
  inside("<axis xyz=\"0 0 1\"/>", "arm.urdf:11: joint \"c\" has no <limit>; add <limit lower=");
  inside("<axis xyz=\"0 0 1\"/>", "joint \"c\" has no <limit>; add <limit velocity=", "continuous");
  inside("<limit lower=\"-1\" upper=\"1\"/>", "joint \"c\" has no velocity in its <limit>");
  inside("<limit lower=\"-1\" upper=\"1\" velocity=\"0\"/>", "joint \"c\" has velocity=\"0\"");
  inside("<limit lower=\"1\" upper=\"1\" velocity=\"2\"/>",
         "joint \"c\" has the limits 1 to 1; lower must be below upper");
  inside("<mimic joint=\"a\"/><limit lower=\"-1\" upper=\"1\" velocity=\"2\"/>",
         "arm.urdf:11: joint \"c\" follows another joint (<mimic>)");
  inside("", "joint \"c\" has the type \"floating\"", "floating");
  with(2, "<joint name=\"c\" type=\"revolute\"><child link=\"3\"/></joint>\n",
       "joint \"c\" has no <parent> link");
  inside("<limit lower=\"-180\" upper=\"1\" velocity=\"2000\"/>",
         "arm.urdf: the robot in this file is invalid: joint.c.speed_max_rad_per_s = 2000 is outside");
  with(2,
       joint("c", "2", "3", "<axis xyz=\"0 0 1\"/><limit lower=\"-20\" upper=\"1\" velocity=\"2\"/>",
             "prismatic"),
       "arm.urdf: the robot in this file is invalid: joint.c.min_rad = -20 is outside");
  return all;
}

TEST(Urdf, SaysWhatIsWrongWithAFileAndWhere) {
  EXPECT_GE(broken_files().size(), 20u);
  for (const Broken& broken : broken_files()) EXPECT_SAYS(refusal(broken.text), broken.words);
}

TEST(Urdf, SaysWhichLinksThereAre) {
  proto::Robot wanted;
  wanted.set_tip_link("7");
  EXPECT_SAYS(refusal(File().text(), wanted), "robot.tip_link = \"7\": arm.urdf has no such link");
  wanted.set_tip_link("0");
  EXPECT_SAYS(refusal(File().text(), wanted), "0 joints are movable");
  wanted.set_tip_link("6");
  wanted.set_base_link("3");
  EXPECT_SAYS(refusal(File().text(), wanted), "3 joints are movable (d, e, f)");
  wanted.set_tip_link("2");
  EXPECT_SAYS(refusal(File().text(), wanted), "link \"2\" is not connected to \"3\"");
}

TEST(Urdf, EndsInAClosedChain) {
  File file;
  file.joints[0] = joint("a", "6", "1", "", "fixed");
  for (int i = 1; i < 6; ++i)
    file.joints[static_cast<std::size_t>(i)] = joint(std::string(1, static_cast<char>('a' + i)),
                                                     std::to_string(i), std::to_string(i + 1), "", "fixed");
  proto::Robot wanted;
  wanted.set_base_link("1");
  EXPECT_SAYS(refusal(file.text(), wanted), "link \"1\" is part of a closed chain");
  wanted.set_base_link("0");
  wanted.set_tip_link("4");
  EXPECT_SAYS(refusal(file.text(), wanted), "is part of a closed chain; closed chains are not supported");
}

TEST(Urdf, IsBoundedInDepth) {
  std::string deep = "<robot name=\"a\">";
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_SAYS(refusal(deep), "nested too deeply");
}

}  // namespace
}  // namespace longreach::urdf_test
