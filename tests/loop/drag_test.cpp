// Loads that nobody described are dragged, with default settings.

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "deploy/lab/contact/drag.hpp"

namespace longreach::drag_test {
namespace {

TEST(Drag, ALoadIsNoContactAndItsMassIsFound) {
  ExperimentRun run;
  run.config = configure({}, LONGREACH_DEPLOY);
  std::map<std::string, double> all;
  for (const Metric& m : run_drag_study(run)) all[m.name] = m.value;
  EXPECT_EQ(all["dragged"], all.at("drags"));
  EXPECT_EQ(all["phantom_contacts"], 0.0);
  EXPECT_EQ(all["holds"], 0.0);
  EXPECT_EQ(all["stopped_as_without_load"], all.at("drags"));
  EXPECT_GE(all["mass_within_3_sd"], 0.97 * all.at("mass_told"));
  EXPECT_EQ(all["mass_within_5_percent"], all.at("mass_above_noise"));
  EXPECT_EQ(all["known_walls_found"], all.at("known_walls"));
  EXPECT_LE(all["known_wall_found_max_s"], 0.05);
  // All but one (of 4, of 12 at full size) within 50 ms: it takes longer if the link makes the tool stop and go at
  // the moment of the touch.
  EXPECT_GE(all["walls_found"], all.at("walls") - 1.0);
  EXPECT_LE(all["wall_found_max_s"], 0.1);
  EXPECT_EQ(all["nothing_told"], all.at("closed_on_nothing"));
}

// The control: where nothing that a gripper holds may weigh, what it weighs is a contact.
TEST(Drag, WithoutALoadThatMayBeThereItsInertiaIsAContact) {
  ExperimentRun run;
  run.config = configure({"robot.load_max_kg=0"}, LONGREACH_DEPLOY);
  DragCell cell;
  cell.mass_kg = 8.0;
  const DragResult without = run_drag(run, cell);
  EXPECT_GT(without.phantoms, 0);
  run.config = configure({}, LONGREACH_DEPLOY);
  EXPECT_EQ(run_drag(run, cell).phantoms, 0);
}

}  // namespace
}  // namespace longreach::drag_test
