#include "common/rpc/config_change.hpp"

#include <gtest/gtest.h>

namespace longreach::config_change_test {
namespace {

std::string refusal(const std::variant<ConfigChange, Refusal>& planned) {
  const auto* refused = std::get_if<Refusal>(&planned);
  return refused == nullptr ? "" : refused->message;
}

TEST(PlannedChange, IsHeldToTheCeilingOfTheStart) {
  const proto::SlaveConfig start;
  proto::SlaveConfig present;
  present.mutable_command()->set_force_guard_n(10.0);
  EXPECT_EQ(refusal(plan_change({start, present}, {{"command.force_guard_n", "20"}})), "");
  EXPECT_NE(refusal(plan_change({start, present}, {{"command.force_guard_n", "21"}})), "");
  EXPECT_NE(refusal(plan_change({start, present}, {{"sensing.zero_s", "100"}})), "");
  EXPECT_NE(refusal(plan_change({start, present}, {{"scene_file", "scenes/free.txtpb"}})).find("restart"),
            std::string::npos);
}

TEST(PlannedChange, IsWholeOrNone) {
  const proto::MasterConfig start;
  EXPECT_NE(refusal(plan_change({start, start}, {{"rendering.ke", "0.5"}, {"rendering.force_max_n", "16"}})),
            "");
  const auto planned =
      plan_change({start, start}, {{"rendering.ke", "0.5"}, {"rendering.force_max_n", "10"}});
  ASSERT_EQ(refusal(planned), "");
  const auto& after = static_cast<const proto::MasterConfig&>(*std::get<ConfigChange>(planned).after);
  EXPECT_EQ(after.rendering().ke(), 0.5);
  EXPECT_EQ(after.rendering().force_max_n(), 10.0);
  EXPECT_EQ(std::get<ConfigChange>(planned).not_while_engaged, "rendering.ke, rendering.force_max_n");
}

TEST(PlannedChange, IsOfABoundedSize) {
  const proto::SlaveConfig start;
  Assignments many(kAssignmentsMax, {"estimator.forgetting", "0.995"});
  EXPECT_EQ(refusal(plan_change({start, start}, many)), "");
  many.emplace_back("estimator.forgetting", "0.995");
  EXPECT_EQ(refusal(plan_change({start, start}, many)),
            "257 fields and 6425 bytes exceed the limits of one call: 256 fields and 65536 bytes");
  EXPECT_NE(refusal(plan_change({start, start}, {{"estimator.forgetting", std::string(65536, '1')}}))
                .find("exceed the limits of one call"),
            std::string::npos);
}

}  // namespace
}  // namespace longreach::config_change_test
