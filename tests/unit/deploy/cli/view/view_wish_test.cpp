#include "deploy/cli/view/view_wish.hpp"

#include <gtest/gtest.h>

namespace longreach {
namespace {

using Kind = ViewWish::Kind;

TEST(ViewWish, ReadsWhatAPageAsksFor) {
  EXPECT_EQ(read_wish(R"({"take":true})")->kind, Kind::kTake);
  EXPECT_EQ(read_wish(R"({"take":false})")->kind, Kind::kGive);
  EXPECT_EQ(read_wish(R"({"do":"engage"})")->kind, Kind::kEngage);
  EXPECT_EQ(read_wish(R"({"do":"stop"})")->kind, Kind::kStop);
  EXPECT_EQ(read_wish(R"({"mode":"rate"})")->mode, proto::Mapping::RATE);
  EXPECT_EQ(read_wish(R"({"mode":"position"})")->mode, proto::Mapping::POSITION);
  EXPECT_EQ(read_wish(R"({"scale":0.35})")->scale, 0.35);
  EXPECT_EQ(read_wish(R"({"link":"moon-relay"})")->link, "moon-relay");
}

TEST(ViewWish, ReadsAnAim) {
  const auto wish = read_wish(R"({"aim":[0.01,-0.02,3e-3],"turn":[0,0,0.1],"clutch":true,"grip":false})");
  ASSERT_TRUE(wish);
  EXPECT_EQ(wish->kind, Kind::kAim);
  ASSERT_EQ(wish->aim.position_m_size(), 3);
  EXPECT_EQ(wish->aim.position_m(1), -0.02);
  EXPECT_EQ(wish->aim.rotation_rad(2), 0.1);
  EXPECT_TRUE(wish->aim.clutch());
  EXPECT_FALSE(wish->aim.grip());
}

TEST(ViewWish, UnderstandsNothingElse) {
  for (const char* text : {"",
                           "{",
                           "{}",
                           "[]",
                           "null",
                           "1",
                           R"({"do":"dance"})",
                           R"({"mode":"fast"})",
                           R"({"scale":"1"})",
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
    EXPECT_FALSE(read_wish(text)) << text;
  EXPECT_FALSE(read_wish(std::string(4000, '[')));
}

}  // namespace
}  // namespace longreach
