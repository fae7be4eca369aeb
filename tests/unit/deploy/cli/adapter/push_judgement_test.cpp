#include "deploy/cli/adapter/push_judgement.hpp"

#include <gtest/gtest.h>

#include "common/core/random.hpp"

namespace longreach::push_judgement_test {
namespace {

/// A sensor that tells `told` of a push along each axis of W, in a pose R_WE.
template <class Told>
Finding judged(const Matrix3& R_WE, const Told& reported) {
  PushedSensor sensor;
  for (int i = 0; i < 3; ++i)
    sensor.push[static_cast<std::size_t>(i)] = {R_WE, reported(Vector3(20.0 * Vector3::Unit(i)))};
  const std::vector<Finding> found = judge_pushes(sensor);
  EXPECT_EQ(found.size(), 2U);
  return found.back();
}

TEST(PushJudgement, KnowsSignBaseAndExchangedAxesInAnyPose) {
  Random random(3);
  for (int n = 0; n < 200; ++n) {
    const Vector3 turn = Vector3(random.normal(), random.normal(), random.normal()).normalized();
    const Matrix3 R = exp_rotation(random.uniform(1.2, 2.0) * turn).toRotationMatrix();
    const auto right = [&](const Vector3& f) { return Vector3(R.transpose() * f); };
    EXPECT_EQ(judged(R, right).verdict, FindingVerdict::kOk);
    EXPECT_EQ(judged(R, [&](const Vector3& f) { return Vector3(-right(f)); }).text, "has the wrong sign");
    const Finding base = judged(R, [](const Vector3& f) { return f; });
    EXPECT_EQ(base.verdict, FindingVerdict::kFailure);
    const Finding swapped = judged(R, [&](const Vector3& f) {
      const Vector3 e = right(f);
      return Vector3(e.y(), e.x(), e.z());
    });
    EXPECT_EQ(swapped.verdict, FindingVerdict::kFailure);
  }
}

TEST(PushJudgement, SaysWhatItCannotKnow) {
  const Finding found = judged(Matrix3::Identity(), [](const Vector3& f) { return f; });
  EXPECT_EQ(found.verdict, FindingVerdict::kWarning);
  EXPECT_NE(found.advice.find("turn the tool by 90 degrees"), std::string::npos);
}

TEST(PushJudgement, AWeightAndADeadChannelAreTold) {
  PushedSensor sensor;
  sensor.rest = {0.0, 0.0, -12.0};
  for (int i = 0; i < 2; ++i) sensor.push[static_cast<std::size_t>(i)].reported = 20.0 * Vector3::Unit(i);
  const std::vector<Finding> found = judge_pushes(sensor);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].verdict, FindingVerdict::kFailure);
  EXPECT_EQ(found[1].text, "does not respond to a push along z of the base");
}

}  // namespace
}  // namespace longreach::push_judgement_test
