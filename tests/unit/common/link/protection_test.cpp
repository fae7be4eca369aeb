#include "common/link/protection.hpp"

#include <gtest/gtest.h>

#include "tests/support/guide_table.hpp"

namespace longreach::protection_test {
namespace {

TEST(Protection, TheGuideListsEveryCase) {
  std::string table;
  for (unsigned i = 0; i < static_cast<unsigned>(Protection::kCount); ++i) {
    const ProtectionText& text = text_of(static_cast<Protection>(i));
    EXPECT_FALSE(text.missing.empty() || text.effect.empty() || text.when.empty()) << i;
    table += "|";
    for (const std::string_view cell : {text.missing, text.effect, text.when})
      table += " " + std::string(cell) + " |";
    table += "\n";
  }
  expect_guide_table("protections", table);
}

TEST(Protection, AreOneSentenceEach) {
  EXPECT_TRUE(reduced_in_words(0).empty());
  const std::uint32_t both = with(with(0, Protection::kForceGuard, true), Protection::kRpc, true);
  const auto words = reduced_in_words(with(both, Protection::kJointJerk, false));
  ASSERT_EQ(words.size(), 2U);
  EXPECT_EQ(words[0],
            "no force guard: contacts are not detected, and no force is limited (sensing.force is false)");
}

TEST(Protection, UnknownBitsAreNotHidden) { EXPECT_EQ(reduced_in_words(1U << 31).size(), 1U); }

}  // namespace
}  // namespace longreach::protection_test
