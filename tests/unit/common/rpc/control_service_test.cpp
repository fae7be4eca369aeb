#include "common/rpc/control_service.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/common/rpc/control_fake_backend.hpp"

namespace longreach::control_service_test {
namespace {

proto::SetLinkRequest link_request(bool replace) {
  proto::SetLinkRequest request;
  request.set_replace(replace);
  request.mutable_impairment();
  return request;
}

proto::Action linking(const proto::SetLinkRequest& request) {
  proto::Action action;
  *action.mutable_link() = request;
  return action;
}

proto::Action setting(const proto::SetConfigRequest& request) {
  proto::Action action;
  *action.mutable_set() = request;
  return action;
}

const Refusal* refusal_of(const ControlService::Result<proto::Outcome>& result) {
  return std::get_if<Refusal>(&result);
}

TEST(ControlService, ChangesOnlyTheNamedFieldsOfTheLink) {
  FakeBackend side("slave");
  proto::Impairment before;
  before.set_delay_s(0.65);
  before.set_loss(0.02);
  side.put_link(before);
  ControlService service(side);
  auto request = link_request(false);
  request.mutable_impairment()->set_loss(0.1);
  EXPECT_EQ(refusal_of(service.run(linking(request))), nullptr);
  EXPECT_EQ(side.present_link().delay_s(), 0.65);
  EXPECT_EQ(side.present_link().loss(), 0.1);
}

TEST(ControlService, ReplacingTheLinkForgetsWhatIsNotNamed) {
  FakeBackend side("slave");
  proto::Impairment before;
  before.set_delay_s(0.65);
  before.set_queue_s(3.0);
  side.put_link(before);
  ControlService service(side);
  auto request = link_request(true);
  request.mutable_impairment()->set_loss(0.1);
  EXPECT_EQ(refusal_of(service.run(linking(request))), nullptr);
  EXPECT_EQ(side.present_link().delay_s(), 0.0);
  EXPECT_EQ(side.present_link().queue_s(), 0.2);
  EXPECT_EQ(side.present_link().loss(), 0.1);
}

TEST(ControlService, RefusesALinkWithOneImpossibleFieldAsAWhole) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double loss : {1.0 + 1e-9, -1e-9, 1e9, kInfinity, -kInfinity, std::nan("")}) {
    FakeBackend side("slave");
    proto::Impairment before;
    before.set_delay_s(0.65);
    side.put_link(before);
    ControlService service(side);
    auto request = link_request(false);
    request.mutable_impairment()->set_delay_s(1.0);
    request.mutable_impairment()->set_loss(loss);
    const auto result = service.run(linking(request));
    ASSERT_NE(refusal_of(result), nullptr) << loss;
    EXPECT_EQ(refusal_of(result)->kind, Refusal::Kind::kInvalid);
    EXPECT_NE(refusal_of(result)->message.find("loss"), std::string::npos) << refusal_of(result)->message;
    EXPECT_EQ(side.present_link().SerializeAsString(), before.SerializeAsString());
    EXPECT_TRUE(side.calls().empty());
  }
}

TEST(ControlService, AcceptsTheEndsOfEachRangeOfTheLink) {
  FakeBackend side("slave");
  ControlService service(side);
  for (const double loss : {0.0, 1e-300, 5e-324, 1.0}) {
    auto request = link_request(false);
    request.mutable_impairment()->set_loss(loss);
    EXPECT_EQ(refusal_of(service.run(linking(request))), nullptr) << loss;
    EXPECT_EQ(side.present_link().loss(), loss);
  }
}

TEST(ControlService, RefusesAFieldOfTheLinkThatItDoesNotKnow) {
  FakeBackend side("slave");
  ControlService service(side);
  auto request = link_request(false);
  proto::Impairment& link = *request.mutable_impairment();
  link.GetReflection()->MutableUnknownFields(&link)->AddVarint(999, 1);
  const auto result = service.run(linking(request));
  ASSERT_NE(refusal_of(result), nullptr);
  EXPECT_EQ(refusal_of(result)->kind, Refusal::Kind::kInvalid);
  EXPECT_TRUE(side.calls().empty());
}

TEST(ControlService, DoesNotRepeatEndedBlackout) {
  FakeBackend side("slave");
  ControlService service(side);
  auto blackout = link_request(false);
  blackout.mutable_impairment()->set_blackout_duration_s(1e-9);  // over before the next call
  EXPECT_EQ(refusal_of(service.run(linking(blackout))), nullptr);
  EXPECT_EQ(side.present_link().blackout_duration_s(), 1e-9);
  EXPECT_EQ(service.get_link().blackout_duration_s(), 0.0) << "nobody is told that it goes on";
  EXPECT_EQ(service.status().impairment().blackout_duration_s(), 0.0);
  auto loss = link_request(false);
  loss.mutable_impairment()->set_loss(0.1);
  EXPECT_EQ(refusal_of(service.run(linking(loss))), nullptr);
  EXPECT_EQ(side.present_link().blackout_duration_s(), 0.0);
}

TEST(ControlService, HandsRecordingsToTheSideAndSaysWhere) {
  FakeBackend side("slave");
  ControlService service(side);
  proto::Action start, stop;
  start.mutable_start_recording()->set_name("drill");
  stop.mutable_stop_recording();
  const auto started = service.run(start);
  ASSERT_EQ(refusal_of(started), nullptr);
  EXPECT_EQ(std::get<proto::Outcome>(started).message(), "/recordings/drill-slave.mcap");
  EXPECT_EQ(refusal_of(service.run(stop)), nullptr);
  EXPECT_EQ(side.calls(), (std::vector<std::string>{"start_recording drill", "stop_recording"}));
  for (const double max_mb : {0.0, -1.0, 2e6, std::nan("")}) {
    start.mutable_start_recording()->set_max_mb(max_mb);
    ASSERT_NE(refusal_of(service.run(start)), nullptr) << max_mb;
  }
  EXPECT_EQ(side.calls().size(), 2u);
}

TEST(Continued, LeavesALinkThatDoesNotDependOnTimeAsItIs) {
  proto::Impairment link;
  link.set_delay_s(0.65);
  link.set_jitter_s(0.001);
  EXPECT_EQ(continued(link, 12.5).SerializeAsString(), link.SerializeAsString());
}

TEST(Continued, TakesTheDriftIntoTheDelay) {
  proto::Impairment link;
  link.set_delay_s(1.0);
  link.set_drift_s_per_s(-1e-3);
  EXPECT_DOUBLE_EQ(continued(link, 100.0).delay_s(), 0.9);
  EXPECT_EQ(continued(link, 1e9).delay_s(), 0.0);
}

TEST(Continued, BringsWindowsNearerAndEndsThem) {
  struct Case {
    double elapsed_s, start_s, duration_s;
  };
  proto::Impairment link;
  link.set_blackout_start_s(10.0);
  link.set_blackout_duration_s(4.0);
  link.set_step_delay_s(0.1);
  link.set_step_start_s(10.0);
  link.set_step_duration_s(4.0);
  for (const Case& c : {Case{0.0, 10.0, 4.0}, Case{3.0, 7.0, 4.0}, Case{10.0, 0.0, 4.0}, Case{11.0, 0.0, 3.0},
                        Case{14.0, 0.0, 0.0}, Case{1e9, 0.0, 0.0}}) {
    const proto::Impairment later = continued(link, c.elapsed_s);
    EXPECT_EQ(later.blackout_start_s(), c.start_s) << c.elapsed_s;
    EXPECT_EQ(later.blackout_duration_s(), c.duration_s) << c.elapsed_s;
    EXPECT_EQ(later.step_start_s(), c.start_s) << c.elapsed_s;
    EXPECT_EQ(later.step_duration_s(), c.duration_s) << c.elapsed_s;
  }
}

TEST(Continued, KeepsTheBeatOfAPeriodicBlackout) {
  proto::Impairment link;
  link.set_blackout_start_s(10.0);
  link.set_blackout_duration_s(4.0);
  link.set_blackout_period_s(60.0);
  EXPECT_EQ(continued(link, 4.0).blackout_start_s(), 6.0);
  EXPECT_EQ(continued(link, 12.0).blackout_start_s(), 58.0);
  EXPECT_EQ(continued(link, 130.0).blackout_start_s(), 0.0);
  EXPECT_EQ(continued(link, 131.0).blackout_start_s(), 59.0);
  EXPECT_EQ(continued(link, 131.0).blackout_duration_s(), 4.0);
}

TEST(ControlService, SetsAllFieldsOrNone) {
  FakeBackend side("slave");
  ControlService service(side);
  proto::SetConfigRequest request;
  const auto assign = [&request](const char* path, const char* value) {
    proto::Assignment& assignment = *request.add_assignment();
    assignment.set_path(path);
    assignment.set_value(value);
  };
  assign("estimator.forgetting", "0.995");
  assign("estimator.exponent", "17");
  EXPECT_NE(refusal_of(service.run(setting(request))), nullptr);
  proto::GetConfigRequest get;
  get.set_path("estimator.forgetting");
  EXPECT_EQ(std::get<proto::GetConfigResponse>(service.get_config(get)).text(), "0.99");
  request.mutable_assignment(1)->set_value("1.5");
  EXPECT_EQ(refusal_of(service.run(setting(request))), nullptr);
  EXPECT_EQ(std::get<proto::GetConfigResponse>(service.get_config(get)).text(), "0.995");
}

TEST(ControlService, RefusesRequestsWithoutContent) {
  FakeBackend side("slave");
  ControlService service(side);
  proto::SetConfigRequest without_path;
  without_path.add_assignment()->set_value("1");
  for (const auto& result : {service.run(setting({})), service.run(setting(without_path)), service.run({})}) {
    ASSERT_NE(refusal_of(result), nullptr);
    EXPECT_EQ(refusal_of(result)->kind, Refusal::Kind::kInvalid);
  }
  EXPECT_TRUE(side.calls().empty());
}

TEST(ControlService, RefusesScalesBeyondTheirRange) {
  FakeBackend side("master");
  ControlService service(side);
  for (const double scale : {0.0, 0.0499, 1.0001, -1.0, 1e9, std::nan("")}) {
    proto::Action action;
    action.set_scale(scale);
    EXPECT_NE(refusal_of(service.run(action)), nullptr) << scale;
  }
  EXPECT_TRUE(side.calls().empty());
  for (const double scale : {0.05, 1.0}) {
    proto::Action action;
    action.set_scale(scale);
    EXPECT_EQ(refusal_of(service.run(action)), nullptr) << scale;
  }
}

TEST(ControlService, RefusesKvBeyondItsRange) {
  FakeBackend side("master");
  ControlService service(side);
  for (const double kv_per_s : {0.0, 1001.0, -1.0, std::nan("")}) {
    proto::Action action;
    action.set_kv_per_s(kv_per_s);
    EXPECT_NE(refusal_of(service.run(action)), nullptr) << kv_per_s;
  }
  EXPECT_TRUE(side.calls().empty());
}

TEST(ControlService, UnknownPathsAreInvalid) {
  FakeBackend side("slave");
  ControlService service(side);
  proto::GetConfigRequest request;
  request.set_path("estimator.nonsense");
  const auto result = service.get_config(request);
  ASSERT_TRUE(std::holds_alternative<Refusal>(result));
  EXPECT_EQ(std::get<Refusal>(result).kind, Refusal::Kind::kInvalid);
}

}  // namespace
}  // namespace longreach::control_service_test
