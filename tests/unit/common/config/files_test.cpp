#include <gtest/gtest.h>
#include <sys/stat.h>

#include "common/config/deploy_folder.hpp"
#include "common/config/user_file.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/common/config/error_of.hpp"

namespace longreach::files_test {
namespace {

namespace fs = std::filesystem;

const std::string kRobot =
    "name: \"arm\" joint { a_m: 1 } joint { a_m: 1 } joint { a_m: 1 } joint { a_m: 1 } joint { a_m: 1 } "
    "joint { a_m: 0.5 } servo_hz: 7";
const std::string kScene =
    "name: \"wall\" material { name: \"steel\" }\nsurface { name: \"front\" material: \"steel\" plane { "
    "normal: [1, 0, 0] } }";

class ResolveFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("robots/space_arm.txtpb", kRobot);
    folder.write("scenes/wall.txtpb", kScene);
  }
  // The error; the configuration must then be as it was.
  std::string resolve_error() {
    const std::string before = config.SerializeAsString();
    const std::string error = error_of([&] { resolve_files(config, folder.path()); });
    if (error != "no error") {
      EXPECT_EQ(config.SerializeAsString(), before);
    }
    return error;
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder.path() / name).string(); }

  TemporaryFolder folder;
  proto::SlaveConfig config;
};

TEST_F(ResolveFiles, ReadsTheFilesThatAreNamed) {
  EXPECT_EQ(resolve_error(), "no error");
  EXPECT_EQ(config.robot().name(), "arm");
  EXPECT_EQ(config.robot().joint(5).a_m(), 0.5);
  EXPECT_EQ(config.scene().surface(0).material(), "steel");
  const proto::SlaveConfig once = config;
  folder.write("robots/space_arm.txtpb", "joint {");  // not read again
  EXPECT_EQ(resolve_error(), "no error");
  EXPECT_EQ(config.SerializeAsString(), once.SerializeAsString());
}

TEST_F(ResolveFiles, TakesAnAbsolutePathAsItIs) {
  const TemporaryFolder elsewhere;
  config.set_robot_file(elsewhere.write("mine.txtpb", kRobot + " basis: \"mine\"").string());
  EXPECT_EQ(resolve_error(), "no error");
  EXPECT_EQ(config.robot().basis(), "mine");
}

TEST_F(ResolveFiles, PutsFieldsInPlaceOverThoseOfTheRobotsFile) {
  config.mutable_robot()->set_servo_hz(0.0);
  EXPECT_EQ(resolve_error(), "no error");
  EXPECT_EQ(config.robot().servo_hz(), 0.0);
  EXPECT_EQ(config.robot().joint_size(), 6);
}

TEST_F(ResolveFiles, TakesWhatIsGivenInPlace) {
  for (int i = 0; i < 6; ++i) config.mutable_robot()->add_joint()->set_a_m(0.1 * (i + 1));
  config.mutable_scene();  // free space
  config.set_robot_file("none.txtpb");
  config.set_scene_file("");
  EXPECT_EQ(resolve_error(), "no error");
  EXPECT_EQ(config.robot().joint(3).a_m(), 0.1 * 4);
  EXPECT_EQ(config.scene().surface_size(), 0);
}

TEST_F(ResolveFiles, UsesRobotOfSceneUnlessAnotherIsNamed) {
  folder.write("robots/mine.txtpb", kRobot + " basis: \"mine\"");
  folder.write("scenes/wall.txtpb", kScene + " robot_file: \"robots/mine.txtpb\"");
  const proto::SlaveConfig empty = config;
  EXPECT_EQ(resolve_error(), "no error");
  EXPECT_EQ(config.robot().basis(), "mine");
  config = empty;
  config.set_robot_file("robots/space_arm.txtpb");
  EXPECT_EQ(resolve_error(), "no error");
  EXPECT_EQ(config.robot().basis(), "");
}

// Each bad scene is refused with file, line, field and reason.
TEST_F(ResolveFiles, RefusesBadScenes) {
  const auto refused = [&](const std::string& material, const std::string& surface) {
    folder.write("scenes/wall.txtpb", "material { name: \"m\"\n" + material +
                                          " }\nsurface { name: \"s\" material: \"m\"\n" + surface + " }");
    const std::string error = resolve_error(), file = path("scenes/wall.txtpb") + ":";
    EXPECT_TRUE(error.starts_with(file)) << error;
    return error.starts_with(file) ? error.substr(file.size()) : error;
  };
  const std::string good = "sphere {}";
  EXPECT_EQ(refused("stiffness_n_per_m: -1", good),
            "2:1: material.m.stiffness_n_per_m = -1 is outside 0 (excluded) to 1e9");
  EXPECT_EQ(refused("exponent: 0", good), "2:1: material.m.exponent = 0 is outside 1 to 3");
  EXPECT_EQ(refused("exponent: nan", good), "2:1: material.m.exponent = nan is not a finite number");
  EXPECT_EQ(refused("damping_s_per_m: -0.1", good),
            "2:1: material.m.damping_s_per_m = -0.1 is outside 0 to 100");
  EXPECT_TRUE(refused("", "cone {}").starts_with("4:1: unknown field \"cone\""));
  EXPECT_EQ(refused("", ""), "3:1: surface.s has no shape; give it a plane, sphere, box, cylinder or hinge");
  EXPECT_EQ(refused("", "sphere { radius_m: 0 }"),
            "4:10: surface.s.sphere.radius_m = 0 is outside 0 (excluded) to 1000");
  EXPECT_EQ(refused("", "box { size_m: [1, -1, 1] }"),
            "4:7: surface.s.box.size_m.1 = -1 is outside 0 (excluded) to 1000");
  EXPECT_EQ(refused("", "cylinder { axis: [0, 0, 0] }"),
            "4:12: surface.s.cylinder.axis has length 0, which is outside the range 1e-9 to 1e9, so it does "
            "not define a direction");
  config.set_scene_file("scenes/none.txtpb");
  EXPECT_EQ(resolve_error(),
            "scene_file = \"scenes/none.txtpb\": the file does not exist in " + folder.path().string());
}

// Nobody writes into a FIFO, and a device has no end.
TEST_F(ResolveFiles, ReadsRegularFilesOfABoundedSizeAlone) {
  const auto error_with = [this](const fs::path& file) {
    folder.write("scenes/wall.txtpb", "bodies { mjcf_file: \"scenes/b.xml\" }");
    fs::remove(folder.path() / "scenes/b.xml");
    fs::create_symlink(file, folder.path() / "scenes/b.xml");
    return resolve_error();
  };
  const fs::path fifo = folder.path() / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  const std::string name = path("scenes/b.xml");
  EXPECT_EQ(error_with(fifo), name + ": is not a regular file");
  EXPECT_EQ(error_with("/dev/zero"), name + ": is not a regular file");
  EXPECT_EQ(error_with(folder.path()), name + ": is a folder; name a file in it");
  const fs::path large = folder.write("large.xml", "<mujoco/>");
  fs::resize_file(large, kUserFileMaxBytes + 1);  // a hole: it takes no room
  EXPECT_EQ(error_with(large), name + ": is longer than 64 MiB");
  fs::rename(fifo, folder.path() / "scenes/wall.txtpb");
  EXPECT_EQ(resolve_error(), path("scenes/wall.txtpb") + ": is not a regular file");
}

// A scene's bodies bring an MJCF file, which brings meshes; a mesh is closed.
TEST_F(ResolveFiles, ReadsTheFilesOfBodiesAndRefusesOpenMeshes) {
  const std::string solid = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n";
  folder.write("scenes/wall.txtpb", "bodies { mjcf_file: \"scenes/b.xml\" }");
  EXPECT_EQ(resolve_error(), "scene.bodies.mjcf_file = \"scenes/b.xml\": the file does not exist in " +
                                 path("scenes") + " or " + folder.path().string());
  folder.write("scenes/b.xml", "<mujoco>\n<mesh name='m' file='m.obj'/></mujoco>");
  EXPECT_EQ(resolve_error(),
            path("scenes/b.xml") + ":2: " + path("scenes/m.obj") + ": there is no such file");
  const std::string mesh = path("scenes/m.obj");
  folder.write("scenes/m.obj", solid);
  EXPECT_EQ(resolve_error(),
            mesh + ":5: the mesh is not closed: an edge of this face belongs to no other face");
  folder.write("scenes/m.obj", solid + "f 1 3 4\n");
  EXPECT_EQ(resolve_error(), mesh +
                                 ":8: the face has an edge in the same direction as the face on line "
                                 "5; list the vertices of each face anticlockwise, as seen from outside");
  folder.write("scenes/m.obj", solid + "f 1 4 5\n");
  EXPECT_EQ(resolve_error(), mesh +
                                 ":8: the face refers to vertex \"5\", but only 4 vertices are "
                                 "defined before it");
  folder.write("scenes/m.obj", "v 0 0 0\n");
  EXPECT_EQ(resolve_error(), mesh + ": the mesh has no faces");
  folder.write("scenes/b.xml", "<mujoco><mesh file='m.stl'/></mujoco>");
  EXPECT_EQ(resolve_error(), path("scenes/b.xml") +
                                 ":1: \"m.stl\" is not an OBJ file in the MJCF file's folder; copy "
                                 "the mesh there as an OBJ file");
  folder.write("scenes/b.xml", "<mujoco>\n<mesh name='m' file='m.obj'/></mujoco>");
  folder.write("scenes/m.obj", solid + "f 1/1 4/2 3/3\n");
  EXPECT_EQ(resolve_error(), "no error");
  ASSERT_EQ(config.scene().bodies().file_size(), 2);
  EXPECT_EQ(config.scene().bodies().file(0).name(), "scenes/b.xml");
  EXPECT_EQ(config.scene().bodies().file(1).name(), "m.obj");
  // A setting that names another file is obeyed, also after the first was read.
  folder.write("other.xml", "<mujoco/>");
  config.mutable_scene()->mutable_bodies()->set_mjcf_file("other.xml");
  EXPECT_EQ(resolve_error(), "no error");
  ASSERT_EQ(config.scene().bodies().file_size(), 1);
  EXPECT_EQ(config.scene().bodies().file(0).name(), "other.xml");
}

TEST_F(ResolveFiles, NamesTheFileThatIsAtFault) {
  config.set_robot_file("robots/none.txtpb");
  EXPECT_EQ(resolve_error(),
            "robot_file = \"robots/none.txtpb\": the file does not exist in " + folder.path().string());
  config.set_robot_file("");
  EXPECT_EQ(resolve_error(), "robot_file is empty; name a file, or set the fields of robot");
  config.clear_robot_file();

  folder.write("robots/space_arm.txtpb", "name: \"arm\"");
  EXPECT_EQ(resolve_error(), path("robots/space_arm.txtpb") + ": the robot has 0 joints; 6 are needed");
  folder.write("robots/space_arm.txtpb", "joint {}\njoint {}");
  EXPECT_EQ(resolve_error(), path("robots/space_arm.txtpb") + ":1:1: joint has 2 elements; 6 are needed");
  folder.write("robots/space_arm.txtpb", kRobot + "\n");
  folder.write("scenes/wall.txtpb",
               "material { name: \"steel\" }\nsurface { name: \"a\" material: \"wood\" }");
  EXPECT_EQ(resolve_error(),
            path("scenes/wall.txtpb") +
                ":2:21: surface.a.material = \"wood\" is not a material of the scene; it has: steel");
  folder.write("scenes/wall.txtpb", "surface { name: \"a\"\n material: \"wood\" }");
  EXPECT_EQ(resolve_error(),
            path("scenes/wall.txtpb") +
                ":2:2: surface.a.material = \"wood\" is not a material of the scene; it has: none");
  folder.write("scenes/wall.txtpb", "material { name: \"m\" }\nmaterial {\n  name: \"m\"\n}");
  EXPECT_EQ(resolve_error(), path("scenes/wall.txtpb") +
                                 ":3:3: material.1.name = \"m\" is already the name of another material");
  folder.write(
      "scenes/wall.txtpb",
      "material { name: \"m\" }\nsurface { name: \"a\" material: \"m\" plane {\n normal: [0, 0, 0] } }");
  EXPECT_EQ(resolve_error(),
            path("scenes/wall.txtpb") +
                ":3:2: surface.a.plane.normal has length 0, which is outside the range 1e-9 to 1e9, "
                "so it does not define a direction");
}

// Each bad row is refused with file, line, field and reason.
TEST_F(ResolveFiles, RefusesBadRowsOfARobot) {
  const auto refused = [&](const std::string& third_row, const std::string& after = "") {
    std::string text = "joint { a_m: 1 }\njoint { a_m: 1 }\njoint { " + third_row + " }\n";
    for (int i = 0; i < 3; ++i) text += "joint { a_m: 1 }\n";
    folder.write("robots/space_arm.txtpb", text + after);
    const std::string error = resolve_error(), file = path("robots/space_arm.txtpb") + ":";
    return error.starts_with(file) ? error.substr(file.size()) : error;
  };
  EXPECT_EQ(refused("a_m: 1"), "no error");
  config.Clear();
  EXPECT_EQ(refused("a_m: nan"), "3:9: joint.2.a_m = nan is not a finite number");
  EXPECT_EQ(refused("a_m: 1 alpha_rad: inf"), "3:16: joint.2.alpha_rad = inf is not a finite number");
  EXPECT_EQ(refused("a_m: 1 min_rad: 2 max_rad: 1"), "3:16: joint.2.min_rad = 2 is not below max_rad = 1");
  EXPECT_EQ(refused("a_m: 0 alpha_rad: 0"),
            "3:16: joint.2.alpha_rad = 0 with a_m = 0 makes joints 2 and 3 rotate about the same axis, so a "
            "degree of freedom is lost");
  EXPECT_EQ(refused("a_m: 1", "joint {}"), "1:1: joint has 7 elements; 6 are needed");
  EXPECT_EQ(refused("a_m: 1 kind: FIXED"),
            "1:1: joint has 0 prismatic and 1 fixed joints; a robot needs either six revolute or prismatic "
            "joints (at most three of them prismatic) or three prismatic and three fixed joints");
  EXPECT_EQ(refused("a_m: 1 d_m: 400"),
            "3:16: joint.2.d_m = 400 is outside the range -100 to 100, and larger magnitudes are "
            "allowed only next to nearly parallel axes; lengths are in m, but this value seems to be "
            "in mm");
  EXPECT_EQ(refused("a_m: 1 beta_rad: 0.01", "convention: MODIFIED"),
            "3:16: joint.2.beta_rad = 0.01 is allowed only with convention: STANDARD");
  EXPECT_EQ(refused("a_m: 1 speed_max_rad_per_s: 0"),
            "3:16: joint.2.speed_max_rad_per_s = 0 is outside 0 (excluded) to 100");
}

TEST_F(ResolveFiles, RefusesPrismaticJointsThatMoveInAPlaneOnly) {
  std::string text;
  for (const char* twist : {"0", "1.5707963267948966", "0"})
    text += "joint { kind: PRISMATIC alpha_rad: " + std::string(twist) + " }\n";
  for (int i = 0; i < 3; ++i) text += "joint { kind: FIXED }\n";
  folder.write("robots/space_arm.txtpb", text);
  EXPECT_EQ(resolve_error(),
            path("robots/space_arm.txtpb") +
                ":2:25: joint.1.alpha_rad = 1.5707963267948966: the three prismatic joints can move "
                "the tool only in a plane");
}

TEST_F(ResolveFiles, ChecksTheWholeAfterwards) {
  config.mutable_sensing()->set_release_n(0.5);
  config.mutable_sensing()->set_touch_n(0.3);
  EXPECT_EQ(resolve_error(), "sensing.release_n = 0.5 is not below touch_n = 0.3");
  config.clear_sensing();
  config.mutable_sensing()->set_force_range_n(20.0);
  EXPECT_EQ(resolve_error(), "sensing.force_range_n = 20 is not above command.force_guard_n = 20");
  config.clear_sensing();
  config.mutable_sensing()->set_moment(true);
  config.mutable_sensing()->set_moment_range_nm(5.0);
  EXPECT_EQ(resolve_error(), "sensing.moment_range_nm = 5 is not above command.moment_guard_nm = 5");
  config.mutable_sensing()->set_moment(false);
  EXPECT_EQ(resolve_error(), "no error") << "no moment is guarded where none is measured";
  config.clear_sensing();
  config.mutable_command()->set_force_guard_n(5.0);
  EXPECT_EQ(resolve_error(),
            "command.force_guard_n = 5 cannot be enforced when the tool touches a surface with a stiffness "
            "of 5000 N/m at 0.05 m/s; the minimum is 8.6; set it to that value, or lower "
            "command.speed_max_m_per_s to 0.0339");
  // What is advised is allowed, and does.
  config.mutable_sensing()->set_force_range_n(8.0);
  EXPECT_EQ(resolve_error(),
            "command.force_guard_n = 5 cannot be enforced when the tool touches a surface with a stiffness "
            "of 5000 N/m at 0.05 m/s; the minimum is 8.6, which sensing.force_range_n = 8 does not allow; "
            "lower command.speed_max_m_per_s to 0.0339");
  config.clear_sensing();
  config.mutable_command()->set_speed_max_m_per_s(0.0339);
  EXPECT_EQ(resolve_error(), "no error");
  config.mutable_command()->set_speed_max_m_per_s(0.01);
  EXPECT_EQ(resolve_error(), "no error");
  config.Clear();
  config.mutable_robot()->add_joint();
  EXPECT_EQ(resolve_error(), "robot has 1 joints; 6 are needed");
}

TEST_F(ResolveFiles, RecognisesDegrees) {
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string robot = kRobot;
    robot.replace(robot.find(from), from.size(), to);
    folder.write("robots/space_arm.txtpb", robot);
    return resolve_error();
  };
  EXPECT_NE(refused("a_m: 1", "a_m: 1 alpha_rad: 90")
                .find("alpha_rad = 90 is outside -3.2 to 3.2; the unit is rad, but this value seems to "
                      "be in degrees: 90 degrees are 1.57"),
            std::string::npos);
  EXPECT_NE(refused("servo_hz: 7", "tool { rotation_rad: [0, 0, 90] }")
                .find("tool.rotation_rad has length 90, which is more than one turn; the unit is rad, "
                      "but this value seems to be in degrees"),
            std::string::npos);
}

TEST(LinkProfiles, LoadByNameAndListTheKnownOnes) {
  const TemporaryFolder folder;
  folder.write("links/moon.txtpb", "up { delay_s: 1.3 }");
  folder.write("links/lab.txtpb", "name: \"lab\"");
  folder.write("links/README.md", "");
  EXPECT_EQ(load_link_profile(folder.path(), "moon").up().delay_s(), 1.3);
  EXPECT_EQ(load_link_profile(folder.path(), "moon").name(), "moon");
  const auto error = [&](const std::string& name) {
    return error_of([&] { load_link_profile(folder.path(), name); });
  };
  const std::string links = (folder.path() / "links").string();
  EXPECT_EQ(error("mon"),
            "there is no link profile \"mon\" in " + links + "; did you mean \"moon\"? Known: lab, moon");
  EXPECT_EQ(error("mars"), "there is no link profile \"mars\" in " + links + "; known: lab, moon");
  for (const std::string name : {"../links/moon", "/etc/passwd", "", ".", "..", "a\\b", ".hidden"}) {
    EXPECT_EQ(error(name),
              "\"" + name +
                  "\" is not a valid name of a link profile; give one of the names lab, moon, or the path "
                  "of a .txtpb file");
  }
  folder.write("mine.txtpb", "up { delay_s: 0.7 }");
  const std::string mine = (folder.path() / "mine.txtpb").string();
  EXPECT_EQ(load_link_profile(folder.path(), mine).up().delay_s(), 0.7);
  EXPECT_NE(error("/nowhere/mine.txtpb").find("/nowhere/mine.txtpb: there is no such file"),
            std::string::npos)
      << error("/nowhere/mine.txtpb");
  folder.write("links/moon.txtpb", "up { delay_s: -1 }");
  EXPECT_EQ(error("moon"), links + "/moon.txtpb:1:6: up.delay_s = -1 is outside 0 to 100");
  EXPECT_EQ(error_of([&] { load_link_profile(folder.path() / "x", "moon"); }),
            "there is no link profile \"moon\" in " + folder.path().string() + "/x/links; known: none");
}

TEST(DeployFolder, PrefersEnvironmentThenProgramThenWorkingFolder) {
  const TemporaryFolder folder;
  const fs::path root = folder.path();
  for (const char* name : {"home/links", "program/deploy/links", "work/deploy/robots",
                           "program/build/deploy/cli", "program/build/bin", "work/a/b", "empty"}) {
    fs::create_directories(root / name);
  }
  const fs::path program = root / "program/build/bin";
  EXPECT_EQ(find_deploy_folder({(root / "home").string(), program, root / "work/a/b"}), root / "home");
  // build/deploy is nearer, but holds nothing that a user edits.
  EXPECT_EQ(find_deploy_folder({std::nullopt, program, root / "work/a/b"}), root / "program/deploy");
  EXPECT_EQ(find_deploy_folder({"", root / "empty", root / "work/a/b"}), root / "work/deploy");
  EXPECT_EQ(error_of([&] {
              find_deploy_folder({(root / "empty").string(), program, root});
            }),
            "LONGREACH_HOME = " + (root / "empty").string() +
                " contains none of the folders config, links, devices, robots, scenes; set it to the deploy "
                "folder");
  EXPECT_EQ(error_of([&] {
              find_deploy_folder({std::nullopt, root / "empty", root / "home"});
            }),
            "there is no deploy folder above " + (root / "empty").string() + " or " +
                (root / "home").string() +
                "; set LONGREACH_HOME to the folder that contains config, links, devices, robots and scenes");
}

}  // namespace
}  // namespace longreach::files_test
