// MCAP files as they are written and read: whole, cut anywhere, damaged, without room.
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/dynamic_message.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>

#include "common/core/random.hpp"
#include "common/recording/mcap_reader.hpp"
#include "common/recording/mcap_writer.hpp"
#include "common/recording/recording_error.hpp"
#include "proto/recording.pb.h"
#include "tests/support/temporary_folder.hpp"

namespace longreach::mcap_test {
namespace {

std::string read_all(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_all(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

recording::Event event(int i) {
  recording::Event out;
  out.set_text("event " + std::to_string(i));
  return out;
}

/// `chunks` chunks of ten messages on two topics each.
void write_sample(const std::filesystem::path& path, int chunks) {
  RecordingFile file(path);
  McapWriter writer(file, "test");
  writer.add_metadata("longreach", {{"side", "slave"}, {"seed", "7"}});
  const auto events = writer.add_channel("/slave/event", *recording::Event::descriptor());
  const auto links = writer.add_channel("/slave/link", *recording::Link::descriptor());
  for (int i = 0; i < 10 * chunks; ++i) {
    writer.write(events, 1000u + static_cast<unsigned>(i), event(i));
    recording::Link link;
    link.set_loss(0.125 * i);
    writer.write(links, 1000u + static_cast<unsigned>(i), link);
    if (i % 10 == 9) writer.flush();
  }
  writer.finish();
}

/// Events in the file; each must be the next one. `lost` ones are missing after the first ten.
int count_events(McapReader& reader, int lost = 0) {
  int events = 0;
  while (const auto message = reader.next()) {
    if (message->channel->topic != "/slave/event") continue;
    recording::Event read;
    EXPECT_TRUE(read.ParseFromArray(message->bytes.data(), static_cast<int>(message->bytes.size())));
    const int number = events < 10 ? events : events + lost;
    EXPECT_EQ(read.text(), "event " + std::to_string(number));
    EXPECT_EQ(message->sequence, static_cast<unsigned>(number));
    EXPECT_EQ(message->log_time_ns, 1000u + static_cast<unsigned>(number));
    ++events;
  }
  return events;
}

TEST(Mcap, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  write_sample(folder.path() / "a.mcap", 5);
  McapReader reader(folder.path() / "a.mcap");
  EXPECT_EQ(count_events(reader), 50);
  EXPECT_TRUE(reader.whole());
  EXPECT_EQ(reader.metadata().at("longreach"), (TextMap{{"seed", "7"}, {"side", "slave"}}));
  const McapFigures figures = mcap_figures(folder.path() / "a.mcap");
  EXPECT_EQ(figures.messages, 100u);
  EXPECT_EQ(figures.first_ns, 1000u);
  EXPECT_EQ(figures.last_ns, 1049u);
  EXPECT_TRUE(figures.whole);
}

TEST(Mcap, AnEmptyFileIsWhole) {
  const TemporaryFolder folder;
  {
    RecordingFile file(folder.path() / "a.mcap");
    McapWriter(file, "test").finish();
  }
  McapReader reader(folder.path() / "a.mcap");
  EXPECT_FALSE(reader.next());
  EXPECT_TRUE(reader.whole());
  EXPECT_EQ(mcap_figures(folder.path() / "a.mcap").messages, 0u);
}

TEST(Mcap, BringsTheSchemasThatItsMessagesNeed) {
  const TemporaryFolder folder;
  write_sample(folder.path() / "a.mcap", 1);
  {
    RecordingFile file(folder.path() / "b.mcap");
    McapWriter writer(file, "test");
    const auto ticks = writer.add_channel("/slave/tick", *recording::SlaveTick::descriptor());
    recording::SlaveTick tick;
    tick.mutable_input()->mutable_robot()->mutable_joint_rad()->set_joint3(0.75);
    writer.write(ticks, 5, tick);
    writer.finish();
  }
  McapReader reader(folder.path() / "b.mcap");
  const auto message = reader.next();
  ASSERT_TRUE(message);
  const McapSchema& schema = reader.schemas().at(message->channel->schema);
  EXPECT_EQ(schema.name, "longreach.recording.SlaveTick");
  google::protobuf::FileDescriptorSet files;
  ASSERT_TRUE(files.ParseFromString(schema.descriptors));
  google::protobuf::DescriptorPool pool;
  for (const auto& file : files.file()) ASSERT_NE(pool.BuildFile(file), nullptr) << file.name();
  google::protobuf::DynamicMessageFactory factory(&pool);
  const auto* type = pool.FindMessageTypeByName(schema.name);
  ASSERT_NE(type, nullptr);
  const std::unique_ptr<google::protobuf::Message> read(factory.GetPrototype(type)->New());
  ASSERT_TRUE(read->ParseFromArray(message->bytes.data(), static_cast<int>(message->bytes.size())));
  EXPECT_NE(read->DebugString().find("joint3: 0.75"), std::string::npos) << read->DebugString();
}

TEST(Mcap, KeepsLargeMessages) {
  const TemporaryFolder folder;
  const std::string text(3'000'000, 'x');
  {
    RecordingFile file(folder.path() / "a.mcap");
    McapWriter writer(file, "test");
    recording::Event large;
    large.set_text(text);
    writer.write(writer.add_channel("/x", *recording::Event::descriptor()), 1, large);
    writer.finish();
  }
  McapReader reader(folder.path() / "a.mcap");
  const auto message = reader.next();
  ASSERT_TRUE(message);
  recording::Event read;
  ASSERT_TRUE(read.ParseFromArray(message->bytes.data(), static_cast<int>(message->bytes.size())));
  EXPECT_TRUE(read.text() == text);
}

TEST(Mcap, CutAnywhereHoldsTheChunksBefore) {
  const TemporaryFolder folder;
  write_sample(folder.path() / "a.mcap", 4);
  const std::string bytes = read_all(folder.path() / "a.mcap");
  int most = 0;
  for (std::size_t size = 8; size < bytes.size(); size += 37) {
    write_all(folder.path() / "cut.mcap", bytes.substr(0, size));
    McapReader reader(folder.path() / "cut.mcap");
    const int events = count_events(reader);
    ASSERT_EQ(events % 10, 0) << size;
    ASSERT_GE(events, most) << size;
    most = events;
    ASSERT_EQ(mcap_figures(folder.path() / "cut.mcap").messages, 2u * static_cast<unsigned>(events)) << size;
  }
  EXPECT_EQ(most, 40);
}

// One damaged chunk costs its own messages, and the reader names its period.
TEST(Mcap, ReadsTheRestOfADamagedFile) {
  const TemporaryFolder folder;
  write_sample(folder.path() / "a.mcap", 4);
  std::string bytes = read_all(folder.path() / "a.mcap");
  bytes[bytes.find("event 12") + 6] = '7';
  write_all(folder.path() / "b.mcap", bytes);
  McapReader whole(folder.path() / "a.mcap"), reader(folder.path() / "b.mcap");
  EXPECT_EQ(count_events(whole), 40);
  EXPECT_TRUE(whole.lost().empty());
  EXPECT_EQ(count_events(reader, 10), 30);
  EXPECT_TRUE(reader.whole());
  ASSERT_EQ(reader.lost().size(), 1u);
  EXPECT_LT(reader.lost()[0].first_ns, reader.lost()[0].last_ns);
  EXPECT_EQ(reader.lost()[0].why, "a chunk has an incorrect checksum");
  const std::vector<LostChunk> lost{{2'000'000'000, 3'500'000'000, "a chunk has an incorrect checksum"}};
  EXPECT_EQ(lost_sentence(lost, 1'000'000'000),
            "data is lost from 1.000 s to 2.500 s, because a chunk has an incorrect checksum");
}

// Nothing can be read: the reason is the error.
TEST(Mcap, RefusesAFileWhoseChunksAreAllDamaged) {
  const TemporaryFolder folder;
  write_sample(folder.path() / "a.mcap", 1);
  std::string bytes = read_all(folder.path() / "a.mcap");
  bytes[bytes.find("event 2") + 6] = '7';
  write_all(folder.path() / "b.mcap", bytes);
  McapReader reader(folder.path() / "b.mcap");
  try {
    count_events(reader);
    FAIL() << "the damage was not detected";
  } catch (const RecordingError& e) {
    EXPECT_NE(std::string(e.what()).find("b.mcap is damaged: a chunk has an incorrect checksum"),
              std::string::npos)
        << e.what();
  }
}

TEST(Mcap, IsNoOtherFile) {
  const TemporaryFolder folder;
  write_all(folder.path() / "a.txt", "This is a text.\n");
  write_all(folder.path() / "b.txt", "");
  EXPECT_THROW(McapReader(folder.path() / "a.txt"), RecordingError);
  EXPECT_THROW(McapReader(folder.path() / "b.txt"), RecordingError);
  EXPECT_THROW(McapReader(folder.path() / "none.mcap"), RecordingError);
  EXPECT_THROW(RecordingFile(folder.path() / "a.txt"), RecordingError) << "nothing is overwritten";
}

TEST(Mcap, OfHostileBytesIsReadOrRefused) {
  const TemporaryFolder folder;
  write_sample(folder.path() / "a.mcap", 3);
  const std::string bytes = read_all(folder.path() / "a.mcap");
  Random random(3);
  int refused = 0;
  for (int i = 0; i < 1000; ++i) {
    std::string mutated = bytes;
    for (std::uint64_t j = 0; j <= random.next() % 4; ++j)
      mutated[8 + random.next() % (bytes.size() - 8)] = static_cast<char>(random.next());
    write_all(folder.path() / "b.mcap", mutated);
    try {
      McapReader reader(folder.path() / "b.mcap");
      while (reader.next()) {
      }
      (void)mcap_figures(folder.path() / "b.mcap");
    } catch (const RecordingError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 10);
  EXPECT_LT(refused, 1000);
}

/// Files may have at most so many bytes while this lives, as if the disk were full then.
class FileLimit {
 public:
  explicit FileLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }
  FileLimit(const FileLimit&) = delete;
  FileLimit& operator=(const FileLimit&) = delete;

 private:
  rlimit before_{};
};

TEST(Mcap, WithoutRoomEndsWithTheLastWholeChunk) {
  const TemporaryFolder folder;
  std::string error;
  {
    RecordingFile file(folder.path() / "a.mcap");
    McapWriter writer(file, "test");
    const auto events = writer.add_channel("/slave/event", *recording::Event::descriptor());
    const FileLimit limit(20'000);
    for (int i = 0; i < 2000; ++i) {
      writer.write(events, 1000u + static_cast<unsigned>(i), event(i));
      if (i % 10 == 9) writer.flush();
    }
    writer.finish();
    error = file.error();
    EXPECT_TRUE(file.failed());
    EXPECT_LE(file.size(), 20'000u);
  }
  EXPECT_EQ(error, "File too large");
  McapReader reader(folder.path() / "a.mcap");
  const int events = count_events(reader);
  EXPECT_GT(events, 100);
  EXPECT_EQ(events % 10, 0);
  EXPECT_FALSE(reader.whole());
}

std::string little_endian(std::uint64_t value, int bytes) {
  std::string out;
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i));
  return out;
}
std::string record(std::uint8_t op, const std::string& content) {
  return static_cast<char>(op) + little_endian(content.size(), 8) + content;
}
std::string text(const std::string& text) { return little_endian(text.size(), 4) + text; }

/// A file of one channel and one chunk, whose bytes another program has packed.
void write_packed(const std::filesystem::path& path, const std::string& how, const std::string& packed,
                  std::uint64_t size) {
  const std::string magic = "\x89MCAP0\r\n";
  const std::string channel = little_endian(1, 2) + little_endian(0, 2) + text("/a") + text("x") + text("");
  const std::string chunk = little_endian(1, 8) + little_endian(1, 8) + little_endian(size, 8) +
                            little_endian(0, 4) + text(how) + little_endian(packed.size(), 8) + packed;
  write_all(path, magic + record(1, text("") + text("")) + record(4, channel) + record(6, chunk) +
                      record(15, little_endian(0, 4)) + magic);
}

std::string from_hex(std::string_view hex) {
  std::string out;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    out += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
  return out;
}

// A message record of 64 letters a, packed by the programs zstd 1.5.4 and lz4 1.9.4.
TEST(Mcap, ReadsChunksThatOtherProgramsCompressed) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "packed.mcap";
  const std::pair<const char*, const char*> packed[] = {
      {"zstd", "28b52ffd245fad00006805560000000000000001000161020004924840124e915077"},
      {"lz4", "04224d186440a7180000003205560001003f0100010100001f610100275061616161610000000053becfdf"}};
  for (const auto& [how, hex] : packed) {
    write_packed(path, how, from_hex(hex), 95);
    McapReader reader(path);
    const auto message = reader.next();
    ASSERT_TRUE(message) << how;
    EXPECT_EQ(message->channel->topic, "/a");
    EXPECT_EQ(message->bytes, std::string(64, 'a'));
    EXPECT_FALSE(reader.next());
    EXPECT_TRUE(reader.whole());
  }
}

TEST(Mcap, SaysWhyACompressedChunkIsNotRead) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "packed.mcap";
  const auto error = [&](const std::string& how, const std::string& bytes,
                         std::uint64_t size) -> std::string {
    write_packed(path, how, bytes, size);
    McapReader reader(path);
    try {
      (void)reader.next();
    } catch (const RecordingError& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_EQ(error("brotli", "x", 95),
            path.string() +
                ": its chunks are compressed with \"brotli\", but only zstd and lz4 are supported; "
                "recompress it with one of them");
  for (const char* how : {"zstd", "lz4"}) {
    EXPECT_EQ(error(how, "nonsense", 95), path.string() + ": a compressed chunk cannot be decompressed");
    EXPECT_EQ(error(how, "", 95), path.string() + ": a compressed chunk cannot be decompressed");
    EXPECT_NE(error(how, "x", std::uint64_t{1} << 60U).find("exceeds the maximum of 256 MiB"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace longreach::mcap_test
