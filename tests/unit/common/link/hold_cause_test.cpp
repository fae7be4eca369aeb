// The one table of causes: complete, without doubles, and the guide's.
#include "common/link/hold_cause.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/guide_table.hpp"

namespace longreach::hold_cause_test {
namespace {

std::vector<HoldCause> all_causes() {
  std::vector<HoldCause> all;
  for (int i = 1; i < kCountOf<HoldCause>; ++i) all.push_back(static_cast<HoldCause>(i));
  return all;
}

TEST(HoldCauses, EachHasItsOwnNameAndSentenceAndARemedy) {
  std::set<std::string_view> seen;
  for (const HoldCause cause : all_causes()) {
    const CauseText& text = text_of(cause);
    EXPECT_TRUE(seen.insert(text.name).second) << text.name;
    EXPECT_TRUE(seen.insert(text.sentence).second) << text.sentence;
    EXPECT_FALSE(text.name.empty() || text.sentence.empty() || text.remedy.empty()) << text.name;
    EXPECT_NE(text.name, "unknown");
  }
  EXPECT_EQ(text_of(HoldCause::kNone).name, "");
  EXPECT_EQ(with_remedy(HoldCause::kNone), "");
  EXPECT_EQ(text_of(static_cast<HoldCause>(kCountOf<HoldCause>)).name, "unknown");
  EXPECT_EQ(text_of(static_cast<HoldCause>(200)).name, "unknown");
}

TEST(HoldCauses, ThePlaceIsInTheSentence) {
  EXPECT_EQ(sentence({HoldCause::kJointLimit, 5, 2.15, 2.0944}),
            "joint 5 of the robot is at 2.15 rad (or m), beyond its limit of 2.094");
  EXPECT_EQ(sentence({HoldCause::kJointJumped, 3, 1.5, 0.25}),
            "joint 3 of the robot jumped from 0.25 to 1.5 rad (or m), faster than the joint can move");
  EXPECT_EQ(sentence({HoldCause::kToolOutside, 0, 0.612, 0.5}),
            "the tool is 0.612 m from the centre of its workspace, whose radius is 0.5 m");
  EXPECT_EQ(sentence({HoldCause::kSurfaceApproaching, 0, -1.0, 0.0}),
            "a surface is moving towards the robot; the direction of retreat is -x");
  EXPECT_EQ(sentence({HoldCause::kSurfaceApproaching, 0, 3.0, 0.0}),
            "a surface is moving towards the robot; the direction of retreat is +z");
  for (const HoldCause cause : all_causes()) {
    EXPECT_NE(sentence({cause, 2, 1e300, -1e300}).find("joint 2"), std::string::npos) << text_of(cause).name;
    EXPECT_EQ(sentence(cause), text_of(cause).sentence);
  }
}

TEST(HoldCauses, TheGuideHasTheTable) {
  std::string table;
  for (const HoldCause cause : all_causes()) {
    const CauseText& text = text_of(cause);
    table += "| " + std::string(text.name) + " | " + std::string(text.sentence) + " | " +
             std::string(text.remedy) + " |\n";
  }
  expect_guide_table("causes", table);
}

}  // namespace
}  // namespace longreach::hold_cause_test
