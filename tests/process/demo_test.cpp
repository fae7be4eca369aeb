// `longreach demo` with each supplied scene and with one that a user wrote.
#include <gtest/gtest.h>

#include <sstream>
#include <thread>

#include "tests/process/running_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::demo_test {
namespace {

namespace fs = std::filesystem;

void expect_engaged(const std::string& scene) {
  SCOPED_TRACE(scene);
  RunningProgram demo("longreach",
                      {"demo", "--profile", "lab", "--seconds", "4", "--set", "scene_file=" + scene});
  const auto status = demo.wait(std::chrono::seconds(60));
  const std::string output = demo.output();
  // In 4 s, the simulated operator may not reach the surface, so that the verdict is not compared.
  EXPECT_TRUE(status == 0 || status == 1) << output;
  EXPECT_NE(output.find("verdict: "), std::string::npos) << output;
  EXPECT_NE(output.find("ok    engaged for "), std::string::npos) << output;
}

TEST(Demo, RunsWithEachSuppliedScene) {
  int scenes = 0;
  for (const auto& file : fs::directory_iterator(fs::path(LONGREACH_DEPLOY) / "scenes")) {
    if (file.path().extension() != ".txtpb") continue;
    expect_engaged("scenes/" + file.path().filename().string());
    ++scenes;
  }
  EXPECT_GE(scenes, 7);
}

TEST(Demo, RunsWithASceneOfAUser) {
  const TemporaryFolder folder;
  expect_engaged(folder
                     .write("box.txtpb",
                            "name: \"box\"\n"
                            "material { name: \"steel\" stiffness_n_per_m: 5000 damping_s_per_m: 0.1 }\n"
                            "surface { name: \"box\" material: \"steel\"\n"
                            "          box { centre_m: [0.05, 0, 0] size_m: [0.04, 0.02, 0.04] } }\n")
                     .string());
}

/// The answer of the slave of a demo, at the addresses that the demo prints.
std::string answer(const std::string& printed, const std::string& path) {
  std::istringstream line(printed.substr(0, printed.find(" status")));
  std::vector<std::string> words;
  for (std::string word; line >> word;) {
    words.push_back(word);
    if (word.ends_with("/longreach")) words.clear();
  }
  words.insert(words.end(), {"get", "slave", path});
  RunningProgram client("longreach", words);
  client.wait(std::chrono::seconds(30));
  return client.output();
}

TEST(Demo, ATaskHasItsScene) {
  for (const char* task : {"path", "dock"}) {
    RunningProgram demo("longreach",
                        {"demo", "--task", task, "--operator", "none", "--profile", "lab", "--seconds", "8"});
    for (int n = 0; n < 600 && demo.output().find(" --participant") == std::string::npos; ++n)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const std::string printed = demo.output();
    EXPECT_NE(printed.find(std::string("task ") + task + " --participant"), std::string::npos) << printed;
    EXPECT_NE(answer(printed, "scene.name").find(task), std::string::npos) << printed;
    EXPECT_TRUE(demo.wait(std::chrono::seconds(60)).has_value()) << demo.output();
  }
}

}  // namespace
}  // namespace longreach::demo_test
