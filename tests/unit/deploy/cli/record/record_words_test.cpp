// `longreach record` as it is typed.
#include <gtest/gtest.h>

#include "deploy/cli/command_line.hpp"

namespace longreach::record_words_test {
namespace {

using What = RecordCommand::What;

RecordCommand command(std::vector<const char*> words) {
  words.insert(words.begin(), "longreach");
  const auto parsed = parse_command_line(static_cast<int>(words.size()), words.data());
  return std::get<RecordCommand>(std::get<Invocation>(parsed).command);
}

std::string refusal(const std::vector<const char*>& words) {
  try {
    (void)command(words);
    return "";
  } catch (const UsageError& error) {
    return error.what();
  }
}

TEST(RecordWords, SayWhatIsToBeDone) {
  EXPECT_EQ(command({"record", "start"}).what, What::kStart);
  EXPECT_EQ(command({"record", "start"}).name, "");
  EXPECT_EQ(command({"record", "start"}).max_mb, 4096.0);
  EXPECT_EQ(command({"record", "start", "drill-3", "--max-mb", "100"}).name, "drill-3");
  EXPECT_EQ(command({"record", "start", "drill-3", "--max-mb", "100"}).max_mb, 100.0);
  EXPECT_EQ(command({"record", "stop"}).what, What::kStop);
  EXPECT_EQ(command({"record", "list", "/somewhere"}).what, What::kList);
  EXPECT_EQ(command({"record", "list", "/somewhere"}).folder, "/somewhere");
  const RecordCommand tables = command({"record", "export", "a.mcap", "--csv", "--out", "tables"});
  EXPECT_EQ(tables.what, What::kExport);
  EXPECT_EQ(tables.files, std::vector<std::string>{"a.mcap"});
  EXPECT_EQ(tables.folder, "tables");
}

TEST(RecordWords, AreRefusedWithWhatIsWrong) {
  EXPECT_NE(refusal({"record"}), "");
  EXPECT_NE(refusal({"record", "dance"}), "");
  EXPECT_NE(refusal({"record", "export"}).find("FILE"), std::string::npos);
  EXPECT_NE(refusal({"record", "start", "--max-mb", "0"}).find("--max-mb = 0 is not"), std::string::npos);
  EXPECT_NE(refusal({"record", "start", "--max-mb", "much"}).find("--max-mb = much"), std::string::npos);
}

}  // namespace
}  // namespace longreach::record_words_test
