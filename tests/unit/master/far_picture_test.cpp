#include <gtest/gtest.h>

#include "master/master_node.hpp"

namespace longreach::far_picture_test {
namespace {

struct Bench {
  void tick() {
    in.now += std::chrono::milliseconds(1);
    in.last_heard = in.now;
    node.step(in);
  }
  void receive(const Received<BodyPoses>& news) {
    in.bodies = {&news, 1};
    tick();
    in.bodies = {};
  }
  [[nodiscard]] const BodyPoses& shown() const { return node.view().bodies; }

  MasterNode node{MasterConfig{}};
  MasterInput in{};
};

TEST(FarPicture, CountsTheAgesOfTheBodies) {
  Bench b;
  Received<BodyPoses> news{};
  news.message.body[1] = BodyPose{{{1.0, 2.0, 3.0}, Quaternion::Identity()}, 0.25};
  b.receive(news);
  EXPECT_FALSE(b.shown().body[0]);
  ASSERT_TRUE(b.shown().body[1]);
  EXPECT_EQ(b.shown().body[1]->age_s, 0.25);
  for (int i = 0; i < 700; ++i) b.tick();
  EXPECT_NEAR(b.shown().body[1]->age_s, 0.95, 1e-9);
  EXPECT_EQ(b.shown().body[1]->X_WB.p, Vector3(1.0, 2.0, 3.0));
}

TEST(FarPicture, ShowsTheBodiesOfTheNewestDatagram) {
  Bench b;
  Received<BodyPoses> news{};
  news.message.body[1] = BodyPose{};
  b.receive(news);
  Received<BodyPoses> other{};
  other.message.body[0] = BodyPose{};
  other.newest = false;
  b.receive(other);
  EXPECT_TRUE(b.shown().body[1] && !b.shown().body[0]) << "an overtaken datagram";
  other.newest = true;
  b.receive(other);
  EXPECT_TRUE(b.shown().body[0] && !b.shown().body[1]);
}

TEST(FarPicture, ForgetsTheBodiesOfThePreviousSession) {
  Bench b;
  Received<BodyPoses> news{};
  news.message.body[0] = BodyPose{};
  b.receive(news);
  EXPECT_FALSE(b.shown().empty());
  ++b.in.peer_restarts;
  b.tick();
  EXPECT_TRUE(b.shown().empty());
}

}  // namespace
}  // namespace longreach::far_picture_test
