#include "deploy/cli/status_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "deploy/cli/json_text.hpp"
#include "deploy/cli/view_text.hpp"
#include "proto/state_slave.pb.h"

namespace longreach::status_text_test {
namespace {

BothReports reports() {
  BothReports both;
  both.master = {Side::kMaster, "127.0.0.1:47010", proto::Status(), 0.002};
  both.slave = {Side::kSlave, "127.0.0.1:47020", {}, 0.0, "the slave does not respond"};
  proto::Status& master = *both.master.status;
  master.set_state("Holding");
  master.set_cause("link silent");
  master.mutable_link()->set_rtt_known(true);
  master.mutable_link()->set_rtt_s(1.302);
  master.mutable_link()->set_loss(0.02);
  for (const double x_m : {0.001, -0.0205, 0.0}) master.add_hand_m(x_m);
  for (const auto& [name, count] : {std::pair{"late_ticks", 0U}, std::pair{"rejected_replay", 7U}}) {
    proto::NamedCount& counter = *master.add_counters();
    counter.set_name(name);
    counter.set_count(count);
  }
  return both;
}

TEST(StatusTable, ShowsUnitsAndOmitsUnknownValues) {
  const std::string table = status_table(reports());
  for (const char* part :
       {"Holding (link silent)", "1.302 s", "2 %", "1.00 -20.50 0.00 mm", "127.0.0.1:47020"})
    EXPECT_NE(table.find(part), std::string::npos) << part << " in\n" << table;
  EXPECT_EQ(table.find("stiffness"), std::string::npos) << table;
}

TEST(StatusTable, SaysWhyAnEngagementIsNotGranted) {
  BothReports both = reports();
  both.master.status->set_refusal("at the slave: joint 5 stands beyond its limit");
  EXPECT_NE(status_table(both).find("Not engaged: at the slave: joint 5 stands beyond its limit\n"),
            std::string::npos);
}

TEST(StatusTable, ShowsOnlyCountersThatAreNotZero) {
  const std::string table = status_table(reports());
  EXPECT_NE(table.find("rejected_replay"), std::string::npos);
  EXPECT_EQ(table.find("late_ticks"), std::string::npos);
}

TEST(ValuesTable, NamesEveryValueOnceWithThoseOfInnerMessages) {
  recording::SlaveView view;
  view.set_state(recording::HOLDING);
  view.mutable_tool()->mutable_position_m()->set_x(0.25);
  view.mutable_tool()->mutable_position_m()->set_z(-1e-3);
  view.mutable_estimate()->set_stiffness_n_per_m(1000.0);
  view.mutable_violations_by_limit()->set_joint_jerk(3);
  view.set_approach_m_per_s(-0.0);
  view.set_touch_sequence(2.0 / 3.0);
  const std::vector<NamedValue> values = values_of(view);
  const auto value = [&values](std::string_view name) {
    const auto found = std::ranges::find(values, name, &NamedValue::name);
    return found == values.end() ? "none" : found->value;
  };
  EXPECT_EQ(value("state"), "HOLDING");
  EXPECT_EQ(value("tool.position_m"), "0.25 0 -0.001");
  EXPECT_EQ(value("estimate.stiffness_n_per_m"), "1000");
  EXPECT_EQ(value("estimate.valid"), "false");
  EXPECT_EQ(value("violations_by_limit.joint_jerk"), "3");
  EXPECT_EQ(value("approach_m_per_s"), "0");
  EXPECT_EQ(value("touch_sequence"), "0.666667");
  EXPECT_EQ(value("wrench.force_n"), "none") << "what is absent has no line";
  EXPECT_NE(values_table(view).find("\nin_contact "), std::string::npos);
}

TEST(StatusLine, IsOneLineAndNamesTheSideThatIsDown) {
  const std::string line = status_line(reports());
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_NE(line.find("slave does not respond at 127.0.0.1:47020"), std::string::npos) << line;
}

TEST(StatusJson, HasNullForASideThatIsDownAndSaysWhy) {
  const std::string json = status_json(reports());
  EXPECT_NE(json.find("\"slave\":null"), std::string::npos) << json;
  EXPECT_NE(json.find("\"error\":\"the slave does not respond\""), std::string::npos) << json;
  EXPECT_NE(json.find("\"rtt_s\":1.302"), std::string::npos) << json;
  EXPECT_NE(json.find("\"age_s\":{\"master\":0.002,\"slave\":null}"), std::string::npos) << json;
  EXPECT_EQ(json.find('\n'), std::string::npos);
}

TEST(StatusJson, HasTheSameKeysWhetherAFieldIsSetOrNot) {
  const std::string json = json_object(proto::Impairment());
  const auto* fields = proto::Impairment::descriptor();
  for (int i = 0; i < fields->field_count(); ++i)
    EXPECT_NE(json.find("\"" + fields->field(i)->name() + "\":"), std::string::npos) << json;
  EXPECT_NE(json.find("\"queue_s\":0.2"), std::string::npos) << "the schema's default, not zero: " << json;
}

TEST(JsonString, EscapesWhatJsonDoesNotAllowAndReplacesWhatIsNotUtf8) {
  EXPECT_EQ(json_string("a\"b\\c\nd\x01"), R"("a\"b\\c\nd\u0001")");
  EXPECT_EQ(json_string("\u2264 \U0001F680"), "\"\u2264 \U0001F680\"");
  EXPECT_EQ(json_string("\xff"), R"("\ufffd")");
  EXPECT_EQ(json_string("\xc0\xaf"), R"("\ufffd\ufffd")") << "longer than needed";
  EXPECT_EQ(json_string("\xed\xa0\x80"), R"("\ufffd\ufffd\ufffd")") << "half of a surrogate pair";
  EXPECT_EQ(json_string("\xe2\x89"), R"("\ufffd\ufffd")") << "cut";
  EXPECT_EQ(json_string(std::string_view("\0", 1)), R"("\u0000")");
}

TEST(WithUnit, ChoosesThePrefix) {
  EXPECT_EQ(with_unit(0.65, "s"), "650 ms");
  EXPECT_EQ(with_unit(1.3, "s"), "1.3 s");
  EXPECT_EQ(with_unit(0.0, "J"), "0 J");
  EXPECT_EQ(with_unit(-2e-5, "s"), "-20 us");
  EXPECT_EQ(with_unit(1e-9, "s"), "0.001 us");
  EXPECT_EQ(with_unit(-1.025e-26, "J"), "0 J");
  EXPECT_EQ(with_unit(1e9, "s"), "1e+09 s");
  EXPECT_FALSE(with_unit(std::nan(""), "s").empty());
}

TEST(ImpairmentInWords, SaysWhatIsImpairedAndNothingElse) {
  proto::Impairment link;
  EXPECT_EQ(in_words(link), "none");
  link.set_delay_s(0.65);
  link.set_loss(0.02);
  link.set_loss_burst(4.0);
  link.set_blackout_duration_s(30.0);
  link.set_blackout_period_s(600.0);
  link.set_rpc_delay_s(1.3);
  EXPECT_EQ(
      in_words(link),
      "delay 650 ms, loss 2 % in bursts of 4, blackout for 30 s every 600 s, round trip of calls 1.3 s");
}

}  // namespace
}  // namespace longreach::status_text_test
