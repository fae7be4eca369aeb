#include "slave/slave_reports.hpp"

#include <gtest/gtest.h>

#include "tests/unit/slave/node_loop.hpp"

namespace longreach::slave_reports_test {
namespace {

using test::Loop;

// During an engagement, telemetry keeps a silence of 0.5 s from being a short burst of losses.
TEST(SlaveReports, AndTelemetryKeepTheirPace) {
  SlaveConfig config = test::wall_config(0.9, 1000.0);
  config.link.telemetry_hz = 10.0;
  Loop loop(config);
  loop.run(2.0);
  EXPECT_NEAR(loop.telemetry, 20, 1);
  loop.engage();
  const int reports = loop.reports, telemetry = loop.telemetry;
  loop.run(10.0);
  EXPECT_NEAR(loop.reports - reports, 20, 1);
  EXPECT_NEAR(loop.telemetry - telemetry, 600, 1);
}

// A datagram with news may be lost, and the next heartbeat in free space comes half a second later.
TEST(SlaveReports, NewsThatTheToolIsFreeIsRepeated) {
  Loop loop(test::wall_config(0.02, 1000.0));
  loop.engage();
  loop.move_to(0.025, 0.05), loop.run(1.0);
  ASSERT_TRUE(loop.last_report->translation.in_contact());
  loop.move_to(0.01, 0.05);
  while (loop.last_report->translation.in_contact()) loop.tick();
  const int reports = loop.reports;
  loop.run(0.3);
  EXPECT_NEAR(loop.reports - reports, 3, 1);
  loop.run(1.0);
  EXPECT_NEAR(loop.reports - reports, 5, 1) << "and then at the rate of free space";
}

}  // namespace
}  // namespace longreach::slave_reports_test
