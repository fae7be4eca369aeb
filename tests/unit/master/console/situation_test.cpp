#include "master/console/situation_watch.hpp"

#include <gtest/gtest.h>

#include <set>

#include "master/console/snapshot.hpp"
#include "tests/support/guide_table.hpp"

namespace longreach::situation_test {
namespace {

TEST(Situations, EachHasItsOwnKeyAndATextAndTheGuideHasTheTable) {
  std::set<std::string_view> keys;
  std::string table;
  for (int i = 0; i < static_cast<int>(Situation::kCount); ++i) {
    const SituationText& text = text_of(static_cast<Situation>(i));
    EXPECT_TRUE(keys.insert(text.key).second) << text.key;
    EXPECT_FALSE(text.key.empty() || text.meaning.empty() || text.action.empty()) << text.key;
    table += "| " + std::string(text.key) + " | " + std::string(text.meaning) + " | " +
             std::string(text.action) + " |\n";
  }
  expect_guide_table("situations", table);
  EXPECT_EQ(text_of(Situation::kCount).key, "unknown");
}

/// Steps a watch 50 times a second.
class Course {
 public:
  Course() {
    s_.view.state = s_.view.far_state = SafetyState::kEngaged;
    s_.view.far_known = true;
    s_.link.rtt_s = 0.01;
  }
  ConsoleSnapshot& now() { return s_; }
  MasterView& view() { return s_.view; }
  Situation run(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 50.0 + 0.5); ++i) step();
    return shown_.situation;
  }
  Situation step() {
    s_.seconds += 0.02;
    const Situation before = shown_.situation;
    shown_ = watch_.step(s_);
    changes_ += shown_.situation != before ? 1 : 0;
    return shown_.situation;
  }
  void touch(bool touches, double n = 3.0) {
    s_.view.in_contact = touches;
    s_.view.stiffness_n_per_m = s_.view.surface_n_per_m = 1000.0;
    s_.view.spring_force_n = touches ? Vector3(-n, 0, 0) : Vector3::Zero();
    s_.view.far.F_E_W.force = touches ? Vector3(-n, 0, 0) : Vector3::Zero();
  }
  [[nodiscard]] const Shown& shown() const { return shown_; }
  [[nodiscard]] int changes() const { return changes_; }

 private:
  ConsoleSnapshot s_{};
  SituationWatch watch_;
  Shown shown_{};
  int changes_ = 0;
};

TEST(Situations, AContactIsShownFromHalfASecondOn) {
  Course course;
  EXPECT_EQ(course.run(1.0), Situation::kFree);
  course.touch(true);
  EXPECT_EQ(course.run(0.4), Situation::kFree);
  EXPECT_EQ(course.run(0.2), Situation::kTouching);
  EXPECT_NE(course.shown().sentence.find("3.0 N at the hand, 3.0 N at the tool"), std::string::npos);
  course.touch(false);
  EXPECT_EQ(course.run(0.6), Situation::kFree);
}

TEST(Situations, ContactsThatChatterGetNoWord) {
  Course course;
  course.run(1.0);
  const int before = course.changes();
  for (int i = 0; i < 20; ++i) {
    course.touch(i % 2 == 0);
    course.run(0.06);
  }
  course.touch(false);
  course.run(1.0);
  EXPECT_EQ(course.changes(), before);
}

TEST(Situations, ChangesAtMostTwiceASecondAndAFaultAtOnce) {
  Course course;
  course.run(1.0);
  int before = course.changes();
  for (int i = 0; i < 200; ++i) {
    course.touch(i % 3 == 0);
    course.view().clutched = i % 5 < 2;
    course.view().held = i % 7 != 0;
    course.view().state = i % 11 < 3 ? SafetyState::kHolding : SafetyState::kEngaged;
    course.run(0.1);
  }
  EXPECT_LE(course.changes() - before, 40) << "in 20 s";
  course.view().state = SafetyState::kFault;
  EXPECT_EQ(course.step(), Situation::kFault);
}

TEST(Situations, AMomentaryLimitIsNotListedAndEndsWithTheContact) {
  Course course;
  course.touch(true);
  course.run(1.0);
  course.view().far.clamps.force_guard = true;
  course.run(0.1);
  course.view().far.clamps.force_guard = false;
  EXPECT_EQ(course.run(0.5), Situation::kTouching);
  EXPECT_TRUE(course.shown().limits.empty());
  course.view().stiffness_clamped = true;
  course.run(0.6);
  ASSERT_EQ(course.shown().limits.size(), 1u);
  course.touch(false);
  course.run(0.6);
  EXPECT_TRUE(course.shown().limits.empty());
}

TEST(Situations, ASurfaceThatPushesOrSwingsIsNamed) {
  Course course;
  course.touch(true, 16.0);
  course.view().inward = Vector3::UnitX();
  course.view().far.clamps.force_guard = true;
  course.run(1.0);
  for (int i = 0; i < 100; ++i) {
    course.view().far.X_WE.p.x() -= 3.3e-4;
    course.step();
  }
  EXPECT_EQ(course.shown().situation, Situation::kPushedBack);
  EXPECT_NE(course.shown().sentence.find("by 33 mm: 16.0 N at the hand"), std::string::npos)
      << course.shown().sentence;
  Course swings;
  for (int i = 0; i < 200; ++i) {
    swings.touch(true, 3.0 + std::sin(2.0 * 3.14159 * 3.0 * 0.02 * i));
    swings.step();
  }
  EXPECT_EQ(swings.shown().situation, Situation::kUnsteady);
  swings.touch(true);
  EXPECT_EQ(swings.run(3.0), Situation::kTouching);
}

}  // namespace
}  // namespace longreach::situation_test
