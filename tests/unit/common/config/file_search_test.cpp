// One rule for every file that is named: beside the file that names it, LONGREACH_HOME, the installation.

#include "common/config/file_search.hpp"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"
#include "tests/unit/common/config/error_of.hpp"

namespace longreach::file_search_test {
namespace {

namespace fs = std::filesystem;

std::string robot(const std::string& name) {
  std::string text = "name: \"" + name + "\"";
  for (int i = 0; i < 6; ++i) text += " joint { a_m: 1 }";
  return text;
}

/// A program in the working folder `here` until the end.
class Here {
 public:
  explicit Here(const fs::path& here) : before_(fs::current_path()) { fs::current_path(here); }
  ~Here() { fs::current_path(before_); }
  Here(const Here&) = delete;
  Here& operator=(const Here&) = delete;

 private:
  fs::path before_;
};

class Files : public ::testing::Test {
 protected:
  Files() {
    for (const char* folder : {"installed", "home", "copy"}) {
      const std::string at = folder;
      files.write(at + "/robots/arm.txtpb", robot("arm of " + at));
      files.write(at + "/scenes/free.txtpb", "name: \"free of " + at + "\"");
      files.write(at + "/links/link.txtpb", "up { delay_s: 1 }");
      files.write(at + "/config/slave.txtpb", "");
    }
    config.set_robot_file("robots/arm.txtpb");
    config.set_scene_file("scenes/free.txtpb");
  }
  [[nodiscard]] fs::path path(const std::string& name) const { return files.path() / name; }
  [[nodiscard]] std::string error() {
    return error_of([&] { resolve_files(config, search, nullptr); });
  }

  TemporaryFolder files;
  FileSearch search{{path("home"), path("installed")}};
  proto::SlaveConfig config;
};

TEST_F(Files, OfAnEditedCopyComeBeforeTheInstalledOnes) {
  std::vector<FileRead> read;
  resolve_files(config, search.beside(path("copy/config/slave.txtpb")), &read);
  EXPECT_EQ(config.robot().name(), "arm of copy");
  EXPECT_EQ(config.scene().name(), "free of copy");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].field, "scene_file");
  EXPECT_EQ(read[0].path, path("copy/scenes/free.txtpb"));
  EXPECT_EQ(read[1].path, path("copy/robots/arm.txtpb"));
  EXPECT_EQ(search.beside(path("copy/config/slave.txtpb")).find_named("link profile", "links", "link"),
            path("copy/links/link.txtpb"));
}

TEST_F(Files, AreTakenFromHomeThenFromTheInstallation) {
  fs::remove(path("home/scenes/free.txtpb"));
  EXPECT_EQ(error(), "no error");
  EXPECT_EQ(config.robot().name(), "arm of home");
  EXPECT_EQ(config.scene().name(), "free of installed");
}

TEST_F(Files, ThatASceneNamesAreBesideIt) {
  files.write("mine/wall.txtpb", "name: \"wall\" robot_file: \"own.txtpb\"");
  files.write("mine/own.txtpb", robot("own"));
  config.clear_robot_file();
  config.set_scene_file(path("mine/wall.txtpb").string());
  EXPECT_EQ(error(), "no error");
  EXPECT_EQ(config.robot().name(), "own");
}

TEST_F(Files, ThatAreNowhereAreRefusedWithAllFolders) {
  config.set_robot_file("robots/none.txtpb");
  EXPECT_EQ(error(), "robot_file = \"robots/none.txtpb\": the file does not exist in " +
                         path("home").string() + " or " + path("installed").string());
}

TEST_F(Files, OnACommandLineCountFromTheWorkingFolder) {
  const Here here(files.path());
  files.write("robots/arm.txtpb", robot("arm of here"));
  EXPECT_EQ(placed_setting("slave.robot_file=robots/arm.txtpb", search),
            "slave.robot_file=" + path("robots/arm.txtpb").string());
  // Of the installation; and what names no file.
  for (const std::string same : {"scene_file=scenes/free.txtpb", "scene_file=/x.txtpb", "profile=link",
                                 "command.speed_max_m_per_s=0.1", "robot_file"}) {
    EXPECT_EQ(placed_setting(same, search), same);
  }
  EXPECT_EQ(error_of([&] { placed_setting("robot_file=none.txtpb", search); }),
            "robot_file = \"none.txtpb\": the file does not exist in " + files.path().string() + ", " +
                path("home").string() + " or " + path("installed").string());
  files.write("mylink.txtpb", "up { delay_s: 3 }");
  EXPECT_EQ(load_link_profile(search, "mylink.txtpb").up().delay_s(), 3.0);
  EXPECT_EQ(load_link_profile(search, "copy/links/link.txtpb").up().delay_s(), 1.0);
  EXPECT_EQ(load_link_profile(search, "link").name(), "link");
}

}  // namespace
}  // namespace longreach::file_search_test
