#include "common/config/accuracy.hpp"

#include <gtest/gtest.h>

#include "common/config/config.hpp"

namespace longreach::accuracy_test {
namespace {

TEST(Accuracy, BalancedIsTheDefaultsOfTheSchema) {
  proto::SlaveConfig config;
  apply_accuracy(config);
  config.set_accuracy(proto::BALANCED);
  apply_accuracy(config);
  config.clear_accuracy();
  EXPECT_EQ(config.ByteSizeLong(), 0U);
}

TEST(Accuracy, ChoosesOnBothSidesOfTheDefaults) {
  const proto::MasterConfig balanced;
  proto::MasterConfig fast, exact;
  fast.set_accuracy(proto::FAST);
  exact.set_accuracy(proto::EXACT);
  apply_accuracy(fast);
  apply_accuracy(exact);
  EXPECT_LT(fast.loop().rate_hz(), balanced.loop().rate_hz());
  EXPECT_GT(exact.loop().rate_hz(), balanced.loop().rate_hz());
  EXPECT_LT(fast.link().send_hz(), balanced.link().send_hz());
  EXPECT_GT(exact.link().send_hz(), balanced.link().send_hz());
  validate(fast);
  validate(exact);
}

TEST(Accuracy, GivesWayToWhatIsSet) {
  proto::SlaveConfig config;
  config.set_accuracy(proto::FAST);
  config.mutable_loop()->set_rate_hz(4000.0);
  config.mutable_command()->set_tolerance_m(1e-10);  // the default, but said
  apply_accuracy(config);
  EXPECT_EQ(config.loop().rate_hz(), 4000.0);
  EXPECT_EQ(config.command().tolerance_m(), 1e-10);
  EXPECT_EQ(config.command().iterations_max(), 5U);
  EXPECT_GT(config.estimator().deadband(), proto::Estimator().deadband());
  validate(config);
}

}  // namespace
}  // namespace longreach::accuracy_test
