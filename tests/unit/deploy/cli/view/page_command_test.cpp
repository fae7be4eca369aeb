#include "deploy/cli/view/page_command.hpp"

#include <gtest/gtest.h>

namespace longreach::page_command_test {
namespace {

using Kind = PageCommand::Kind;

TEST(PageCommand, ReadsWhatAPageAsksFor) {
  EXPECT_EQ(read_page_command(R"({"take":true})")->kind, Kind::kTake);
  EXPECT_EQ(read_page_command(R"({"take":false})")->kind, Kind::kGive);
  EXPECT_EQ(read_page_command(R"({"do":"engage"})")->kind, Kind::kEngage);
  EXPECT_EQ(read_page_command(R"({"do":"stop"})")->kind, Kind::kStop);
  EXPECT_EQ(read_page_command(R"({"mode":"rate"})")->mode, proto::RATE);
  EXPECT_EQ(read_page_command(R"({"mode":"position"})")->mode, proto::POSITION);
  EXPECT_EQ(read_page_command(R"({"scale":0.35})")->value, 0.35);
  EXPECT_EQ(read_page_command(R"({"kv":2.5})")->kind, Kind::kKv);
  EXPECT_EQ(read_page_command(R"({"kv":2.5})")->value, 2.5);
  EXPECT_EQ(read_page_command(R"({"link":"moon-relay"})")->link, "moon-relay");
}

TEST(PageCommand, ReadsAnAim) {
  const auto page_command =
      read_page_command(R"({"aim":[0.01,-0.02,3e-3],"turn":[0,0,0.1],"clutch":true,"grip":false})");
  ASSERT_TRUE(page_command);
  EXPECT_EQ(page_command->kind, Kind::kAim);
  ASSERT_EQ(page_command->aim.position_m_size(), 3);
  EXPECT_EQ(page_command->aim.position_m(1), -0.02);
  EXPECT_EQ(page_command->aim.rotation_rad(2), 0.1);
  EXPECT_TRUE(page_command->aim.clutch());
  EXPECT_FALSE(page_command->aim.grip());
}

TEST(PageCommand, UnderstandsNothingElse) {
  for (const char* text : {"",
                           "{",
                           "{}",
                           "[]",
                           "null",
                           "1",
                           R"({"do":"dance"})",
                           R"({"mode":"fast"})",
                           R"({"scale":"1"})",
                           R"({"kv":"up"})",
                           R"({"link":"../../etc/passwd"})",
                           R"({"link":""})",
                           R"({"take":1})",
                           R"({"aim":[1,2]})",
                           R"({"aim":[1,2,"3"]})",
                           R"({"aim":[1,2,1e999]})",
                           R"({"aim":[0,0,0],"turn":[0]})",
                           R"({"do":"stop","mode":"rate"})",
                           R"({"quit":true})",
                           "\xff\xfe",
                           R"({"do":"stop"} trailing)"})
    EXPECT_FALSE(read_page_command(text)) << text;
  EXPECT_FALSE(read_page_command(std::string(4000, '[')));
}

}  // namespace
}  // namespace longreach::page_command_test
