#include <gtest/gtest.h>

#include "common/config/user_file.hpp"
#include "common/core/random.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/common/config/error_of.hpp"

namespace longreach::text_file_test {
namespace {

namespace fs = std::filesystem;

// What load_text_file says about `text`, without "FILE".
template <class Message = proto::MasterConfig>
std::string load_error(const std::string& text) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("a.txtpb", text);
  Message message;
  const std::string error = error_of([&] { load_text_file(file, message); });
  EXPECT_TRUE(error.starts_with(file.string()) || error == "no error") << error;
  return error.starts_with(file.string()) ? error.substr(file.string().size()) : error;
}

TEST(TextFile, LoadsWhatIsThere) {
  const TemporaryFolder folder;
  proto::MasterConfig config;
  config.mutable_loop()->set_priority(7);  // replaced, not merged
  load_text_file(
      folder.write("a.txtpb",
                   "# comment\nmapping { mode: RATE scale: 0.25 }\noperator { direction: [0, 1, 0] }"),
      config);
  EXPECT_EQ(config.mapping().mode(), proto::RATE);
  EXPECT_EQ(config.mapping().scale(), 0.25);
  EXPECT_EQ(config.operator_().direction_size(), 3);
  EXPECT_FALSE(config.has_loop());
  EXPECT_EQ(load_error("# only a comment\n"), "no error");
}

TEST(TextFile, TakesAByteOrderMarkAndSaysWhereOtherTextIsNot) {
  EXPECT_EQ(load_error("\xEF\xBB\xBFmapping { scale: 0.5 }"), "no error");
  EXPECT_EQ(load_error("\xEF\xBB\xBFmapping { scale: 7 }"), ":1:11: mapping.scale = 7 is outside 0.05 to 1");
  EXPECT_EQ(load_error<proto::Scene>("# c\nname: \"w\xE4ll\""),
            ":2:1: name = \"w\\xe4ll\" is not UTF-8: save the file, or enter the text, in UTF-8");
  EXPECT_EQ(load_error("mapping {\n \xC3\xA4: 1 }"),
            ":2:2: there is a non-ASCII character outside quotes; only quoted text may contain such "
            "characters");
}

TEST(TextFile, NamesLineAndColumnOfARangeViolation) {
  EXPECT_EQ(load_error("# c\nmapping {\n  scale: 7\n}\n"), ":3:3: mapping.scale = 7 is outside 0.05 to 1");
  EXPECT_EQ(load_error("mapping {\n\tscale: 0 }\n"), ":2:9: mapping.scale = 0 is outside 0.05 to 1");
  EXPECT_EQ(load_error("loop { priority: 99 }"), ":1:8: loop.priority = 99 is outside 0 to 98");
  EXPECT_EQ(load_error<proto::SlaveConfig>("sensing {\n touch_nm: 0\n}"),
            ":2:2: sensing.touch_nm = 0 is outside 0 (excluded) to 100");
}

TEST(TextFile, RefusesNumbersThatAreNotFinite) {
  EXPECT_EQ(load_error("mapping { scale: nan }"), ":1:11: mapping.scale = nan is not a finite number");
  EXPECT_EQ(load_error("mapping { scale: -inf }"), ":1:11: mapping.scale = -inf is not a finite number");
  EXPECT_EQ(load_error("mapping { scale: 1e999 }"), ":1:11: mapping.scale = inf is not a finite number");
  EXPECT_EQ(load_error("operator { direction: [1, inf, 0] }"),
            ":1:12: operator.direction.1 = inf is not a finite number");
  EXPECT_EQ(load_error("operator {\n direction: 1\n direction: nan\n direction: 0 }"),
            ":3:2: operator.direction.1 = nan is not a finite number");
}

TEST(TextFile, NamesElementsByNameOrIndex) {
  EXPECT_EQ(load_error<proto::Scene>("material {\n name: \"wall\"\n exponent: 4\n}"),
            ":3:2: material.wall.exponent = 4 is outside 1 to 3");
  EXPECT_EQ(load_error<proto::Robot>("joint {}\njoint {}\njoint {}\njoint {}\njoint { a_m: 101 }\njoint {}"),
            ":5:9: joint.4.a_m = 101 is outside -100 to 100");
  EXPECT_EQ(load_error<proto::Robot>("joint { a_m: 1 }"), ":1:1: joint has 1 elements; 6 are needed");
  EXPECT_EQ(load_error("operator { direction: [1, 0] }"),
            ":1:12: operator.direction has 2 elements; 3 are needed");
}

TEST(TextFile, SuggestsTheNameThatWasMeant) {
  EXPECT_EQ(load_error("mapping {\n  scle: 1\n}"),
            ":2:3: unknown field \"scle\" in Mapping; did you mean \"scale\"?");
  EXPECT_EQ(load_error("maping { }"),
            ":1:1: unknown field \"maping\" in MasterConfig; did you mean \"mapping\"?");
  EXPECT_EQ(load_error("safety { colour: 1 }"),
            ":1:10: unknown field \"colour\" in MasterSafety; it has: silence_s, resume_s, engage_at_start, "
            "presence, presence_s, gap_s, delay_rise_max_s");
}

TEST(TextFile, RefusesTooShortGapTimerAndHoldThatLosesContact) {
  EXPECT_EQ(load_error<proto::SlaveConfig>("safety { gap_s: 0.01 }"),
            ":1:10: safety.gap_s = 0.01 is neither 0 (derived from the master's send rate) nor "
            "between 0.02 and 2");
  EXPECT_EQ(
      load_error<proto::SlaveConfig>("command { hold_force_n: 0.4 } sensing { touch_n: 0.4 }"),
      ":1:11: command.hold_force_n = 0.4 is not above sensing.touch_n = 0.4: a hold would lose the contact");
}

TEST(TextFile, ReckonsWithTheBoundOfADerivedTouchThreshold) {
  EXPECT_EQ(load_error<proto::SlaveConfig>("sensing { touch_n: 0 }"), "no error");
  EXPECT_EQ(load_error<proto::SlaveConfig>("command { hold_force_n: 0.3 }"),
            ":1:11: command.hold_force_n = 0.3 is not above the derived touch threshold, 0.3: a hold would "
            "lose the contact");
  EXPECT_NE(load_error<proto::SlaveConfig>("command { hold_force_n: 1 } sensing { force_noise_n: 0.5 }"),
            "no error");
}

TEST(TextFile, ListsTheValuesOfAnEnum) {
  EXPECT_EQ(load_error("mapping { mode: FAST }"), ":1:17: mode = FAST is not one of RATE, POSITION");
  EXPECT_EQ(load_error("mapping { mode: 7 }"), ":1:17: mode = 7 is not one of RATE, POSITION");
}

TEST(TextFile, SaysWhereTheSyntaxBreaks) {
  EXPECT_EQ(load_error("mapping { scale: abc }"), ":1:18: Expected double, got: abc");
  EXPECT_EQ(load_error("mapping {\n scale: 1\n"), ":3:1: Expected identifier, got: the end of the file");
  EXPECT_EQ(load_error("mapping { scale: 1 scale: 1 }"),
            ":1:25: Non-repeated field \"scale\" is specified multiple times");
  EXPECT_EQ(load_error("loop { priority: -1 }"), ":1:18: Expected integer, got: -");
  EXPECT_EQ(load_error("loop { priority: 1.5 }"), ":1:18: Expected integer, got: 1.5");
  EXPECT_EQ(load_error("loop { lock_memory: maybe }"),
            ":1:27: Invalid value for boolean field \"lock_memory\". Value: \"maybe\"");
  EXPECT_EQ(load_error("link { slave: 3 }"), ":1:15: Expected string, got: 3");
}

TEST(TextFile, ChecksFieldsThatMustAgreeAndNamesTheLine) {
  EXPECT_EQ(load_error<proto::SlaveConfig>("sensing {\n release_n: 0.4\n touch_n: 0.3\n}"),
            ":2:2: sensing.release_n = 0.4 is not below touch_n = 0.3");
  EXPECT_EQ(
      load_error<proto::SlaveConfig>("sensing {\n release_n: 0.1\n}"),
      ":2:2: sensing.release_n = 0.1 has no effect while touch_n is 0, because both thresholds are then "
      "derived from the sensor; set touch_n, too");
  EXPECT_EQ(load_error<proto::SlaveConfig>("sensing {\n touch_n: 0.1\n}"),
            ":2:2: sensing.touch_n = 0.1 is not above release_n = 0.12");
}

TEST(TextFile, SaysWhatIsWrongWithTheFileItself) {
  const TemporaryFolder folder;
  proto::MasterConfig config;
  config.mutable_loop()->set_priority(7);
  const auto error = [&](const fs::path& file) { return error_of([&] { load_text_file(file, config); }); };
  const std::string root = folder.path().string();
  EXPECT_EQ(error(folder.path() / "none.txtpb"), root + "/none.txtpb: there is no such file");
  EXPECT_EQ(error(folder.path()), root + ": is a folder; name a file in it");
  EXPECT_EQ(error(folder.write("empty.txtpb", "")),
            root +
                "/empty.txtpb: the file is empty; a file that uses only defaults must contain at "
                "least a comment");
  EXPECT_EQ(error(folder.write("blank.txtpb", " \n\t\n")),
            root +
                "/blank.txtpb: the file is empty; a file that uses only defaults must contain at "
                "least a comment");
  // What a program wrote, with the files of its scene, is long.
  EXPECT_EQ(error(folder.write("long.txtpb", std::string(8 << 20, '#') + "\nloop { priority: 7 }")),
            "no error");
  EXPECT_EQ(error(folder.write("big.txtpb", std::string(kUserFileMaxBytes + 1, '#'))),
            root + "/big.txtpb: is longer than 64 MiB");
  EXPECT_EQ(error(folder.path() / "empty.txtpb" / "x"), root + "/empty.txtpb/x: there is no such file");
  EXPECT_EQ(error("/dev/zero"), "/dev/zero: is not a regular file");
  // Reads of address 0 fail there, for everybody.
  EXPECT_EQ(error("/proc/self/mem"), "/proc/self/mem: cannot be read: Input/output error");
  EXPECT_EQ(config.loop().priority(), 7U);
}

TEST(TextFile, LeavesTheMessageAloneOnError) {
  const TemporaryFolder folder;
  proto::MasterConfig config;
  config.mutable_loop()->set_priority(7);
  const std::string before = config.SerializeAsString();
  for (const char* text : {"mapping { scale: 0.5 } x", "mapping { scale: 9 }", "mapping { scale: 0.5"}) {
    EXPECT_NE(error_of([&] { load_text_file(folder.write("a.txtpb", text), config); }), "no error");
    EXPECT_EQ(config.SerializeAsString(), before) << text;
  }
}

// Whatever the bytes: a valid message or a ConfigError that begins with the file's name.
TEST(TextFile, SurvivesMutatedText) {
  const std::string valid =
      "link { listen: \"0.0.0.0:1\" impairment { delay_s: 0.3 loss: 1e-2 } }\nplayout { adaptive: false }\n"
      "robot { name: \"r\" joint { a_m: 1 } joint { a_m: 1 } joint { a_m: 1 } joint { a_m: 1 } joint { a_m: "
      "1 } joint { min_rad: -1 } }\n"
      "scene { material { name: \"w\" exponent: 1.5 } surface { name: \"s\" material: \"w\" plane { normal: "
      "[0, 0, 1] } } }\n";
  const TemporaryFolder folder;
  int loaded = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    Random random(seed);
    std::string text = valid;
    const int edits = 1 + static_cast<int>(random.next() % 3);
    for (int i = 0; i < edits && !text.empty(); ++i) {
      const std::size_t at = random.next() % text.size();
      const std::size_t length = random.next() % 12;
      switch (random.next() % 4) {
        case 0:
          text[at] = static_cast<char>(random.next());
          break;
        case 1:
          text.erase(at, length);
          break;
        case 2:
          text.insert(at, text.substr(random.next() % text.size(), length));
          break;
        default:
          text.resize(at);
          break;
      }
    }
    const fs::path file = folder.write("fuzz.txtpb", text);
    proto::SlaveConfig config;
    const std::string error = error_of([&] { load_text_file(file, config); });
    if (error == "no error") {
      ++loaded;
      EXPECT_EQ(error_of([&] { validate(config); }), "no error") << "seed " << seed;
    } else {
      ASSERT_TRUE(error.starts_with(file.string() + ":")) << "seed " << seed << ": " << error;
    }
  }
  EXPECT_GT(loaded, 50);  // else the mutations test nothing but the first token
  EXPECT_LT(loaded, 1450);
}

}  // namespace
}  // namespace longreach::text_file_test
