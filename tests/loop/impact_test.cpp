// What `longreach-lab solve impact` answers.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "deploy/lab/contact/impact_oracle.hpp"
#include "deploy/lab/solve/solve.hpp"

namespace longreach::impact_test {
namespace {

using Json = nlohmann::json;

Json answer(const Json& request) {
  std::istringstream in(request.dump());
  std::ostringstream out;
  solve("impact", in, out);
  return Json::parse(out.str());
}

Json impact(const std::string& integrator) {
  return {{"m", 2.0}, {"k", 1e5},   {"lambda", 5e4},           {"n", 1.5},
          {"v", 0.5}, {"dt", 1e-3}, {"integrator", integrator}};
}

TEST(SolveImpact, AnswersAsTheClosedFormSays) {
  const test::ImpactOracle exact{2.0L, 1e5L, 1.5L, 0.5L, 0.5L};
  const Json fixed = answer(impact("discrete_gradient"));
  EXPECT_NEAR(fixed["restitution"].get<double>(), static_cast<double>(exact.restitution()), 1e-13);
  EXPECT_NEAR(fixed["penetration_max"].get<double>(), static_cast<double>(exact.penetration_max()), 1e-14);
  EXPECT_NEAR(fixed["contact_time"].get<double>() / static_cast<double>(exact.duration()), 1.0, 0.01);
  EXPECT_LE(fixed["energy_error"].get<double>(), 1e-13);
  EXPECT_GE(fixed["evaluations"].get<int>(), 30);
  Json without = impact("discrete_gradient");  // the default, and a step that suits
  without.erase("dt");
  without.erase("integrator");
  const Json suited = answer(without);
  EXPECT_NEAR(suited["restitution"].get<double>(), fixed["restitution"].get<double>(), 1e-13);
  EXPECT_NEAR(suited["contact_time"].get<double>() / static_cast<double>(exact.duration()), 1.0, 0.01);
}

// What the others cost in accuracy: the reason for the one.
TEST(SolveImpact, ComparesIntegrators) {
  const double exact = answer(impact("discrete_gradient"))["restitution"].get<double>();
  const auto error = [&](const std::string& name) {
    return std::abs(answer(impact(name))["restitution"].get<double>() - exact);
  };
  EXPECT_GT(error("explicit_euler"), 1e-2);
  EXPECT_GT(error("semi_implicit_euler"), 1e-6);
  EXPECT_GT(error("rk4"), 1e-7);
  EXPECT_LT(error("rk4"), 1e-3);
  Json stiff = impact("explicit_euler");
  stiff["k"] = 1e9;
  EXPECT_GT(answer(stiff)["energy_error"].get<double>(), 1.0);
  stiff["integrator"] = "discrete_gradient";
  EXPECT_LE(answer(stiff)["energy_error"].get<double>(), 1e-12);
}

TEST(SolveImpact, SaysWhatIsWrongWithAQuestion) {
  const auto error = [](const std::string& key, const Json& value) {
    Json request = impact("rk4");
    if (value.is_null()) {
      request.erase(key);
    } else {
      request[key] = value;
    }
    return answer(request).value("error", "none");
  };
  EXPECT_EQ(error("m", 0), "\"m\" must be greater than 0");
  EXPECT_EQ(error("k", -1), "\"k\" must be greater than 0");
  EXPECT_EQ(error("k", nullptr), "key \"k\" is missing");
  EXPECT_EQ(error("n", 0), "\"n\" must be between 1 and 3");
  EXPECT_EQ(error("lambda", -1), "\"lambda\" must not be negative");
  EXPECT_EQ(error("v", "fast"), "\"v\" must be a number");
  EXPECT_EQ(error("stiffness", 1), "unknown key \"stiffness\"");
  EXPECT_EQ(error("integrator", "midpoint"),
            "\"integrator\" = \"midpoint\" is not one of discrete_gradient, explicit_euler, "
            "semi_implicit_euler, rk4");
  EXPECT_NE(error("dt", 1e-12).find("would take more than 10000000 steps"), std::string::npos);
  EXPECT_NE(error("k", 1e-300), "none");
}

}  // namespace
}  // namespace longreach::impact_test
