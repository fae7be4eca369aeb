// The files that ship, each as what its folder says that it is.
#include <gtest/gtest.h>

#include <memory>

#include "common/config/field_text.hpp"
#include "proto/campaign.pb.h"
#include "proto/network.pb.h"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/common/config/error_of.hpp"

namespace longreach::deploy_files_test {
namespace {

namespace fs = std::filesystem;
using google::protobuf::Message;

const fs::path kDeploy = LONGREACH_DEPLOY;

std::unique_ptr<Message> message_for(const fs::path& file) {
  const std::string folder = file.parent_path().filename().string();
  if (folder == "links") return std::make_unique<proto::LinkProfile>();
  if (folder == "devices" && file.stem().string().ends_with("_network"))
    return std::make_unique<proto::SphericalNetwork>();
  if (folder == "devices") return std::make_unique<proto::Device>();
  if (folder == "robots") return std::make_unique<proto::Robot>();
  if (folder == "scenes") return std::make_unique<proto::Scene>();
  if (folder == "cluster") return std::make_unique<proto::Campaign>();
  if (folder != "config") return nullptr;
  const std::string name = file.stem().string();
  if (name.starts_with("master")) return std::make_unique<proto::MasterConfig>();
  if (name.starts_with("slave")) return std::make_unique<proto::SlaveConfig>();
  return std::make_unique<proto::LabConfig>();
}

TEST(DeployFiles, LoadAsWhatTheirFolderSays) {
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kDeploy)) {
    if (entry.path().extension() != ".txtpb") continue;
    const auto message = message_for(entry.path());
    ASSERT_NE(message, nullptr) << entry.path() << " is in a folder that this test does not know";
    EXPECT_EQ(error_of([&] { load_text_file(entry.path(), *message); }), "no error");
    ++files;
  }
  EXPECT_GE(files, 2);
}

TEST(DeployFiles, ResolveTheRobotAndTheSceneOfTheSlave) {
  proto::SlaveConfig config;
  load_text_file(kDeploy / "config/slave.txtpb", config);
  EXPECT_EQ(error_of([&] { resolve_files(config, kDeploy); }), "no error");
  EXPECT_EQ(config.robot().joint_size(), 6);
  EXPECT_GE(config.scene().surface_size(), 1);
}

/// What `--check` prints, as a user would keep it.
template <class Config>
void expect_kept(const TemporaryFolder& folder, const Config& config) {
  Config again;
  const std::string text = get_field(config, "");
  ASSERT_EQ(error_of([&] { load_text_file(folder.write("kept.txtpb", text), again); }), "no error") << text;
  EXPECT_EQ(get_field(again, ""), text);
}

TEST(DeployFiles, AreKeptAsTheyArePrinted) {
  const TemporaryFolder folder;
  for (const std::string kind : {"robot", "scene", "device"}) {
    for (const auto& entry : fs::directory_iterator(kDeploy / (kind + "s"))) {
      if (entry.path().extension() != ".txtpb" || entry.path().stem().string().ends_with("_network"))
        continue;
      SCOPED_TRACE(entry.path());
      proto::SlaveConfig slave;
      proto::MasterConfig master;
      if (kind == "device") {
        set_field(master, "device_file", entry.path().string());
      } else {
        set_field(slave, kind + "_file", entry.path().string());
      }
      resolve_files(slave, kDeploy);
      resolve_files(master, kDeploy);
      expect_kept(folder, slave);
      expect_kept(folder, master);
    }
  }
}

TEST(DeployFiles, GiveTheDefaultLinkOfTheLaboratory) {
  proto::LinkProfile profile;
  EXPECT_EQ(error_of([&] { profile = load_link_profile(kDeploy, proto::LabConfig{}.profile()); }),
            "no error");
  EXPECT_GT(profile.up().delay_s(), 0.0);
}

void expect_defaults(const Message& message) {
  std::vector<const google::protobuf::FieldDescriptor*> fields;
  message.GetReflection()->ListFields(message, &fields);
  const std::unique_ptr<Message> defaults(message.New());
  for (const auto* field : fields) {
    if (holds_messages(*field)) {
      expect_defaults(message_at(message, {field, -1}));
    } else {
      EXPECT_EQ(value_text(message, {field, -1}), value_text(*defaults, {field, -1})) << field->full_name();
    }
  }
}

TEST(DeployFiles, ShowTheDefaultsInTheConfigurationOfBothSides) {
  proto::MasterConfig master;
  load_text_file(kDeploy / "config/master.txtpb", master);
  EXPECT_TRUE(master.has_mapping());
  expect_defaults(master);
  proto::SlaveConfig slave;
  load_text_file(kDeploy / "config/slave.txtpb", slave);
  EXPECT_TRUE(slave.has_command());
  expect_defaults(slave);
}

}  // namespace
}  // namespace longreach::deploy_files_test
