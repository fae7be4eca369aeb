// The datagram of tracked bodies of the adapter protocol: what is valid, and what is ignored.

#include "common/link/adapter_datagram.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace longreach::adapter_datagram_test {
namespace {

using adapter::BodiesDatagram;

BodiesDatagram two_bodies() {
  BodiesDatagram d;
  adapter::Exchange(7).stamp(d);
  d.count = 2;
  d.body[0] = {{1.0, 2.0, 3.0}, {0.5, -0.5, 0.5, 0.5}, 0.25};
  d.body[1].age_s = -1.0;
  return d;
}

bool decodes(const BodiesDatagram& d, std::size_t size = sizeof(BodiesDatagram)) {
  BodiesDatagram out;
  out.count = 77;
  const bool valid = adapter::decode(&d, size, out);
  EXPECT_EQ(out.count, valid ? d.count : 77U) << "an invalid datagram changes nothing";
  return valid;
}

bool decodes_with(const std::function<void(BodiesDatagram&)>& change) {
  BodiesDatagram d = two_bodies();
  change(d);
  return decodes(d);
}

TEST(BodiesDatagram, IsDecodedWithUpToEightBodies) {
  EXPECT_TRUE(decodes(two_bodies()));
  EXPECT_TRUE(decodes_with([](auto& d) { d.count = 0; }));
  EXPECT_TRUE(decodes_with([](auto& d) { d.count = 8; }));
  BodiesDatagram out;
  const BodiesDatagram sent = two_bodies();
  ASSERT_TRUE(adapter::decode(&sent, sizeof sent, out));
  EXPECT_EQ(out.body[0].position_m[2], 3.0);
  EXPECT_EQ(out.body[0].orientation[1], -0.5);
  EXPECT_EQ(out.body[0].age_s, 0.25);
}

TEST(BodiesDatagram, WithTooManyBodiesIsIgnored) {
  EXPECT_FALSE(decodes_with([](auto& d) { d.count = 9; }));
  EXPECT_FALSE(decodes_with([](auto& d) { d.count = std::numeric_limits<std::uint32_t>::max(); }));
}

TEST(BodiesDatagram, WithNumbersThatAreNotFiniteIsIgnored) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN(),
                   kFar = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(decodes_with([](auto& d) { d.body[0].position_m[1] = kNone; }));
  EXPECT_FALSE(decodes_with([](auto& d) { d.body[1].position_m[0] = kFar; }));
  EXPECT_FALSE(decodes_with([](auto& d) { d.body[0].orientation[3] = kNone; }));
  EXPECT_FALSE(decodes_with([](auto& d) { d.body[1].age_s = kNone; }));
  EXPECT_FALSE(decodes_with([](auto& d) { d.body[0].age_s = -kFar; }));
  EXPECT_TRUE(decodes_with([](auto& d) { d.body[2].position_m[0] = kNone; })) << "beyond the count";
}

TEST(BodiesDatagram, WithAQuaternionOfAnotherLengthIsIgnored) {
  EXPECT_FALSE(decodes_with([](auto& d) { d.body[0].orientation[0] = 0.6; }));
  EXPECT_FALSE(decodes_with([](auto& d) { d.body[1].orientation[0] = 0.0; }));
  EXPECT_TRUE(decodes_with([](auto& d) { d.body[1].orientation[0] = 1.0001; }));
}

TEST(BodiesDatagram, TruncatedOrOfAnotherKindIsIgnored) {
  BodiesDatagram d = two_bodies();
  for (const std::size_t size : {std::size_t{0}, sizeof(adapter::Header), sizeof d - 1, sizeof d + 1})
    EXPECT_FALSE(decodes(d, size)) << size;
  d.header.kind = adapter::kRobot;
  EXPECT_FALSE(decodes(d));
  d = two_bodies();
  d.header.session = 0;
  EXPECT_FALSE(decodes(d));
  adapter::RobotDatagram robot;
  d = two_bodies();
  EXPECT_FALSE(adapter::decode(&d, sizeof d, robot)) << "an older version does not take it for the state";
}

}  // namespace
}  // namespace longreach::adapter_datagram_test
