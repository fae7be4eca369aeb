// Recordings as tables and as a list.
#include "deploy/cli/record/csv_export.hpp"

#include <google/protobuf/descriptor.pb.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>

#include "common/recording/mcap_writer.hpp"
#include "common/recording/recording_error.hpp"
#include "common/recording/recording_folder.hpp"
#include "deploy/cli/record/recording_list.hpp"
#include "proto/config.pb.h"
#include "proto/recording.pb.h"
#include "tests/support/temporary_folder.hpp"

namespace longreach::csv_export_test {
namespace {

std::string read_all(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_sample(const std::filesystem::path& path) {
  RecordingFile file(path);
  McapWriter writer(file, "test");
  writer.add_metadata("longreach", {{"side", "slave"}, {"began", "20260102T030405Z"}});
  const auto links = writer.add_channel("/slave/link", *recording::Link::descriptor());
  const auto events = writer.add_channel("/slave/event", *recording::Event::descriptor());
  const auto commands =
      writer.add_channel("/slave/received_command", *recording::ReceivedCommand::descriptor());
  recording::Link link;
  link.set_loss(0.1);
  writer.write(links, 1'000'000'000, link);
  link.set_rtt_s(1.0 / 3.0);
  writer.write(links, 1'500'000'000, link);
  recording::Event event;
  event.set_text("a \"word\", and\nmore");
  writer.write(events, 2'000'000'000, event);
  recording::ReceivedCommand command;
  command.mutable_receipt()->set_sent_ns(-5);
  command.mutable_command()->set_mode(recording::POSITION);
  command.mutable_command()->set_grip(true);
  command.mutable_command()->mutable_position_m()->set_y(-2.5e-7);
  writer.write(commands, 3'500'000'000, command);
  writer.finish();
}

TEST(CsvExport, HasARowAMessageAndAColumnANumber) {
  const TemporaryFolder folder;
  write_sample(folder.path() / "a.mcap");
  const CsvExport written = export_csv(folder.path() / "a.mcap", folder.path() / "new" / "tables");
  const auto& tables = written.tables;
  EXPECT_TRUE(written.whole);
  ASSERT_EQ(tables.size(), 3u);
  EXPECT_EQ(tables[0].file, folder.path() / "new" / "tables" / "slave_link.csv");
  EXPECT_EQ(tables[0].rows, 2u);
  const std::string links = read_all(tables[0].file);
  EXPECT_EQ(links.substr(0, links.find('\n')),
            "t_s,log_time_ns,rtt_s,jitter_s,loss,reorder,silence_s,rate_hz,bytes_per_s,accepted,rejected,"
            "session,missed_ticks,ticks_late_100ms,ticks_not_recorded");
  EXPECT_NE(links.find("\n0,1000000000,,0,0.1,0,"), std::string::npos) << links;  // absent: empty
  EXPECT_NE(links.find("\n0.5,1500000000,0.3333333333333333,0,0.1,"), std::string::npos) << links;
  EXPECT_EQ(read_all(tables[1].file), "t_s,log_time_ns,text\n1,2000000000,\"a \"\"word\"\", and\nmore\"\n");
  const std::string commands = read_all(tables[2].file);
  EXPECT_NE(commands.find("command.position_m.y"), std::string::npos) << commands;
  EXPECT_NE(
      commands.find("\n2.5,3500000000,0,-5,0,,0,,0,HOLD,POSITION,0,1,GOAL_POSITION,0,-2.5e-07,0,,,,0\n"),
      std::string::npos)
      << commands;
}

TEST(CsvExport, ExportsForeignSchemasWithListsAndRecursiveTypes) {
  const TemporaryFolder folder;
  {
    RecordingFile file(folder.path() / "a.mcap");
    McapWriter writer(file, "test");
    proto::Scene scene;
    scene.add_surface()->set_name("one");
    scene.add_surface()->set_name("two");
    writer.write(writer.add_channel("odd/topic name", *proto::Scene::descriptor()), 1, scene);
    writer.finish();
  }
  const auto tables = export_csv(folder.path() / "a.mcap", folder.path()).tables;
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_EQ(tables[0].file.filename(), "odd_topic_name.csv");
  EXPECT_NE(read_all(tables[0].file).find("two"), std::string::npos);
}

TEST(CsvExport, CountsTimeFromAnInstantThatRecordingsShare) {
  const TemporaryFolder folder;
  write_sample(folder.path() / "a.mcap");
  const auto tables = export_csv(folder.path() / "a.mcap", folder.path() / "t", 250'000'000).tables;
  EXPECT_NE(read_all(tables[0].file).find("\n0.75,1000000000,"), std::string::npos)
      << read_all(tables[0].file);
}

TEST(CsvExport, OverwritesNothing) {
  const TemporaryFolder folder;
  write_sample(folder.path() / "a.mcap");
  (void)export_csv(folder.path() / "a.mcap", folder.path() / "t");
  std::ofstream(folder.path() / "t/slave_link.csv") << "edited";
  std::filesystem::remove(folder.path() / "t/slave_event.csv");
  try {
    (void)export_csv(folder.path() / "a.mcap", folder.path() / "t");
    FAIL();
  } catch (const RecordingError& e) {
    EXPECT_EQ(std::string(e.what()), (folder.path() / "t/slave_link.csv").string() +
                                         " already exists; remove it, or give another folder with --out");
  }
  EXPECT_EQ(read_all(folder.path() / "t/slave_link.csv"), "edited");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "t/slave_event.csv"));
}

/// A record of the format: opcode, length, content.
std::string mcap_record(std::uint8_t op, const std::string& content) {
  std::string out(1, static_cast<char>(op));
  for (int i = 0; i < 8; ++i) out += static_cast<char>(content.size() >> (8 * i));
  return out + content;
}
std::string text_field(const std::string& text) {
  std::string out;
  for (int i = 0; i < 4; ++i) out += static_cast<char>(text.size() >> (8 * i));
  return out + text;
}

// As the format's C++ example does: the file of the message first, what it imports behind it; here twice.
TEST(CsvExport, TakesDescriptorsInAnyOrder) {
  const TemporaryFolder folder;
  google::protobuf::FileDescriptorSet files;
  for (int i = 0; i < 2; ++i) {
    proto::Scene::descriptor()->file()->CopyTo(files.add_file());
    google::protobuf::FileOptions::descriptor()->file()->CopyTo(files.add_file());
  }
  proto::Scene scene;
  scene.set_name("found");
  const std::string magic = "\x89MCAP0\r\n", id("\1\0", 2);
  std::ofstream(folder.path() / "a.mcap", std::ios::binary)
      << magic << mcap_record(1, text_field("") + text_field(""))
      << mcap_record(3, id + text_field("longreach.proto.Scene") + text_field("protobuf") +
                            text_field(files.SerializeAsString()))
      << mcap_record(4, id + id + text_field("") + text_field("protobuf") + std::string(4, '\0'))
      << mcap_record(5, id + std::string(20, '\1') + scene.SerializeAsString())
      << mcap_record(15, std::string(4, '\0')) << magic;
  const auto tables = export_csv(folder.path() / "a.mcap", folder.path() / "t").tables;
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_EQ(tables[0].file, folder.path() / "t/topic.csv");
  EXPECT_NE(read_all(tables[0].file).find(",found,"), std::string::npos);
}

TEST(CsvExport, LeavesOutTopicsThatAreNotProtobuf) {
  const TemporaryFolder folder;
  const std::string magic = "\x89MCAP0\r\n", two("\0\0", 2), id("\1\0", 2);
  const std::string channel = mcap_record(
      4, id + two + text_field("/json") + text_field("json") + std::string(4, '\0'));  // without a schema
  const std::string message = mcap_record(5, id + std::string(20, '\1') + "{}");
  std::ofstream(folder.path() / "json.mcap", std::ios::binary)
      << magic << mcap_record(1, text_field("") + text_field("")) << channel << message
      << mcap_record(15, std::string(4, '\0')) << magic;
  try {
    (void)export_csv(folder.path() / "json.mcap", folder.path() / "json");
    FAIL();
  } catch (const RecordingError& e) {
    EXPECT_EQ(std::string(e.what()),
              (folder.path() / "json.mcap").string() +
                  " contains no protobuf messages, and no others can be exported; skipped: /json (json)");
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "json"));
}

/// A recording with one channel of that schema and these messages.
void write_foreign(const std::filesystem::path& path, const std::string& descriptors,
                   const std::vector<std::string>& messages) {
  const std::string magic = "\x89MCAP0\r\n", id("\1\0", 2);
  std::ofstream file(path, std::ios::binary);
  file << magic << mcap_record(1, text_field("") + text_field(""))
       << mcap_record(
              3, id + text_field("longreach.proto.Scene") + text_field("protobuf") + text_field(descriptors))
       << mcap_record(4, id + id + text_field("/ft") + text_field("protobuf") + std::string(4, '\0'));
  for (const std::string& message : messages) file << mcap_record(5, id + std::string(20, '\1') + message);
  file << mcap_record(15, std::string(4, '\0')) << magic;
}

std::string scene_descriptors() {
  google::protobuf::FileDescriptorSet files;
  proto::Scene::descriptor()->file()->CopyTo(files.add_file());
  google::protobuf::FileOptions::descriptor()->file()->CopyTo(files.add_file());
  return files.SerializeAsString();
}

TEST(CsvExport, KeepsTheGoodRowsBesideMessagesThatCannotBeRead) {
  const TemporaryFolder folder;
  proto::Scene scene;
  scene.set_name("good");
  const std::string good = scene.SerializeAsString();
  write_foreign(folder.path() / "a.mcap", scene_descriptors(), {good, "\x0a\x7f", good});
  const CsvExport written = export_csv(folder.path() / "a.mcap", folder.path() / "t");
  ASSERT_EQ(written.tables.size(), 1u);
  EXPECT_EQ(written.tables[0].rows, 2u);
  EXPECT_EQ(written.damaged, std::vector<std::string>{"1 message does not match the schema of /ft"});
}

TEST(CsvExport, NamesTheFileThatIsDamagedAndLeavesNoFolder) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "a.mcap").string();
  std::string not_utf8 = scene_descriptors();
  not_utf8[not_utf8.find("Scene")] = '\xff';
  for (const auto& [descriptors, why] :
       {std::pair{std::string("\x0a\x7f"), "/ft, because the schema longreach.proto.Scene cannot be read"},
        std::pair{not_utf8, "/ft, because the schema longreach.proto.Scene cannot be used: "},
        std::pair{scene_descriptors(), "1 message does not match the schema of /ft"}}) {
    write_foreign(file, descriptors, {"\x0a\x7f"});
    testing::internal::CaptureStderr();
    try {
      (void)export_csv(file, folder.path() / "new" / "t");
      FAIL();
    } catch (const RecordingError& e) {
      EXPECT_EQ(std::string(e.what()).find(file + " is damaged and cannot be exported: " + why), 0u)
          << e.what();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "new"));
  }
}

TEST(CsvExport, GivesTheReasonWhyATableCannotBeWritten) {
  const TemporaryFolder folder;
  write_sample(folder.path() / "a.mcap");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{10, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  std::string why;
  try {
    (void)export_csv(folder.path() / "a.mcap", folder.path() / "t");
  } catch (const RecordingError& e) {
    why = e.what();
  }
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_EQ(why, "cannot write " + (folder.path() / "t/slave_link.csv").string() + ": File too large");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "t"));
}

TEST(Recordings, AreFoundByTheirNamesToo) {
  const TemporaryFolder folder;
  for (const char* name : {"a.mcap", "b-master.mcap", "b-slave.mcap", "c-slave.mcap"})
    write_sample(folder.path() / name);
  using Paths = std::vector<std::filesystem::path>;
  const auto found = [&](const std::string& name) { return find_recordings(folder.path(), name); };
  EXPECT_EQ(found("a"), Paths{folder.path() / "a.mcap"});
  EXPECT_EQ(found("a.mcap"), Paths{folder.path() / "a.mcap"});
  EXPECT_EQ(found("b"), (Paths{folder.path() / "b-master.mcap", folder.path() / "b-slave.mcap"}));
  EXPECT_EQ(found("b-slave"), Paths{folder.path() / "b-slave.mcap"});
  EXPECT_EQ(found("c"), Paths{folder.path() / "c-slave.mcap"});
  EXPECT_EQ(found(folder.path() / "a.mcap"), Paths{folder.path() / "a.mcap"});
  for (const std::string& name : {std::string("none"), std::string(), (folder.path() / "none.mcap").string()})
    EXPECT_THROW((void)found(name), RecordingError) << name;
}

TEST(CsvExport, SaysWhyNot) {
  const TemporaryFolder folder;
  EXPECT_THROW((void)export_csv(folder.path() / "none.mcap", folder.path()), RecordingError);
  write_sample(folder.path() / "a.mcap");
  EXPECT_THROW((void)export_csv(folder.path() / "a.mcap", folder.path() / "a.mcap"), RecordingError);
}

TEST(CsvExport, ReportsTruncatedAndRejectsEmptyRecording) {
  const TemporaryFolder folder;
  write_sample(folder.path() / "a.mcap");
  const std::string bytes = read_all(folder.path() / "a.mcap");
  std::ofstream(folder.path() / "cut.mcap", std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  const CsvExport cut = export_csv(folder.path() / "cut.mcap", folder.path() / "cut");
  EXPECT_FALSE(cut.whole);
  EXPECT_DOUBLE_EQ(cut.last_s, 2.5);
  std::ofstream(folder.path() / "head.mcap", std::ios::binary) << bytes.substr(0, 40);
  EXPECT_THROW((void)export_csv(folder.path() / "head.mcap", folder.path() / "head"), RecordingError);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "head"));
}

TEST(RecordingName, OfALongOneTheBeginningIsRepeated) {
  EXPECT_NO_THROW(check_recording_name("drill-3"));
  for (const std::string& name :
       {std::string(), std::string("a/b"), std::string("-a"), std::string(400, 'a')}) {
    try {
      check_recording_name(name);
      FAIL() << name;
    } catch (const RecordingError& e) {
      EXPECT_NE(std::string(e.what()).find("is not a valid recording name"), std::string::npos);
      EXPECT_LT(std::string(e.what()).size(), 200u) << e.what();
    }
  }
}

TEST(RecordingList, KnowsWhatIsWholeAndWhatIsNot) {
  const TemporaryFolder folder;
  EXPECT_TRUE(list_recordings(folder.path() / "none").empty());
  write_sample(folder.path() / "b.mcap");
  const std::string bytes = read_all(folder.path() / "b.mcap");
  std::ofstream(folder.path() / "c.mcap", std::ios::binary) << bytes.substr(0, bytes.size() - 20);
  std::ofstream(folder.path() / "a.mcap") << "no recording";
  std::ofstream(folder.path() / "text.txt") << "no recording";
  const auto list = list_recordings(folder.path());
  ASSERT_EQ(list.size(), 3u);
  EXPECT_NE(list[0].trouble.find("a.mcap is not a recording"), std::string::npos) << list[0].trouble;
  EXPECT_EQ(list[1].trouble, "");
  EXPECT_EQ(list[1].side, "slave");
  EXPECT_EQ(list[1].began, "20260102T030405Z");
  EXPECT_EQ(list[1].messages, 4u);
  EXPECT_DOUBLE_EQ(list[1].seconds, 2.5);
  EXPECT_TRUE(list[1].whole);
  EXPECT_EQ(list[2].messages, 4u);
}

}  // namespace
}  // namespace longreach::csv_export_test
