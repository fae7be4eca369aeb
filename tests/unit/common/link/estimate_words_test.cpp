#include "common/link/estimate_words.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace longreach::estimate_words_test {
namespace {

ContactEstimate pressed() {
  ContactEstimate e;
  e.valid = true;
  e.stiffness_n_per_m = 1020.0;
  e.stiffness_sd_n_per_m = 5.1;
  e.k = 32e3;
  e.k_sd = 1e3;
  e.lambda = 6.4e3;
  e.lambda_sd = 640.0;
  e.n = 1.5;
  e.n_sd = 0.02;
  e.stiffness_verdict = e.k_verdict = e.lambda_verdict = e.n_verdict = Verdict::kIdentified;
  return e;
}

TEST(EstimateWords, SayWhatIsKnownAndHowWell) {
  EXPECT_EQ(stiffness_in_words(pressed(), "N/m"), "1.02e+03 N/m within 0.5 %");
  EXPECT_EQ(law_in_words(pressed()), "n 1.5 within 0.02, lambda/k 0.2 s/m within 10 %");
}

TEST(EstimateWords, SayWhatIsNotYetKnownAndWhatCannotBeTold) {
  ContactEstimate e = pressed();
  e.n_verdict = Verdict::kNotYet;
  e.lambda_verdict = Verdict::kNotIdentifiable;
  EXPECT_EQ(law_in_words(e), "n not yet known, lambda not identifiable");
  e.correlation = -0.95;
  EXPECT_EQ(law_in_words(e), "n not yet known, lambda not identifiable separately from k");
  e.lambda_verdict = Verdict::kNotYet;
  EXPECT_EQ(law_in_words(e), "n not yet known, lambda not yet known separately from k");
}

TEST(EstimateWords, SayThatTheExponentWasGiven) {
  ContactEstimate e = pressed();
  e.n = 1.0;
  e.n_sd = 1e-6;
  EXPECT_EQ(law_in_words(e), "n 1 as given, lambda/k 0.2 s/m within 10 %");
}

TEST(EstimateWords, AreNoneWithoutAnEstimate) {
  EXPECT_EQ(stiffness_in_words({}, "N/m"), "");
  EXPECT_EQ(law_in_words({}), "");
}

TEST(EstimateWords, SurviveFiguresThatAreNone) {
  for (const double bad : {0.0, 1e300, -1e300, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    ContactEstimate e = pressed();
    e.k = e.k_sd = e.lambda = e.lambda_sd = e.n = e.n_sd = e.correlation = bad;
    e.stiffness_n_per_m = e.stiffness_sd_n_per_m = bad;
    EXPECT_LT((stiffness_in_words(e, "N/m") + law_in_words(e)).size(), 200u);
  }
}

}  // namespace
}  // namespace longreach::estimate_words_test
