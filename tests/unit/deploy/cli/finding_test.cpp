// What the doctor says: lines for people, JSON for programs, bars.
#include "deploy/cli/finding.hpp"

#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <numeric>
#include <sstream>

namespace longreach::finding_test {
namespace {

std::uint64_t total(const Histogram& histogram) {
  return std::accumulate(histogram.bars.begin(), histogram.bars.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const auto& bar) { return sum + bar.count; });
}

TEST(Finding, AHistogramCountsEverythingOnceUnderRisingEdges) {
  for (const std::vector<double>& times : {std::vector<double>{4e-5, 6e-5, 1e-4, 1.2e-3, 0.03},
                                           {0.2, 0.2001, 0.1987, 0.2042},
                                           {2.6, 2.6, 2.6},
                                           {1e-9, 5.0}}) {
    const Histogram histogram = histogram_of(times);
    EXPECT_EQ(total(histogram), times.size());
    ASSERT_FALSE(histogram.bars.empty());
    for (std::size_t i = 1; i < histogram.bars.size(); ++i)
      EXPECT_LT(histogram.bars[i - 1].up_to_s, histogram.bars[i].up_to_s);
    EXPECT_LE(histogram.bars.size(), 32U);
  }
  EXPECT_TRUE(histogram_of({}).bars.empty());
}

TEST(Finding, TimesThatLieCloseTogetherAreToldApart) {
  EXPECT_GE(histogram_of({0.2, 0.21, 0.22, 0.23}).bars.size(), 4U);
  EXPECT_LE(histogram_of({0.2, 0.20001, 0.20002, 0.20003}).bars.size(), 2U)
      << "but not finer than a hundredth";
}

const Diagnosis kDiagnosis = {
    {"Here",
     {{FindingVerdict::kOk, "one", "fine"}, {FindingVerdict::kWarning, "two", "so \"so\"", "mend it"}}},
    {"There",
     {{FindingVerdict::kFailure,
       "three",
       std::string(300, 'a') + " " + std::string(60, 'b') + " " + std::string(60, 'c'),
       "do",
       {{{0.001, 3}, {0.002, 1}}}}}}};

TEST(Finding, TextIsAlignedAndSaysWhatToDo) {
  const std::string text = diagnosis_text(kDiagnosis[0]);
  EXPECT_EQ(text,
            "Here\n"
            "  ok       one              fine\n"
            "  warning  two              so \"so\"\n"
            "                         -> mend it\n");
  std::istringstream lines(diagnosis_text(kDiagnosis[1]));
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  std::getline(lines, line);
  EXPECT_EQ(line.find_first_not_of(' '), 28U) << "continued under the text";
  EXPECT_EQ(diagnosis_summary(kDiagnosis), "1 ok, 1 warning, 1 failure");
}

TEST(Finding, JsonIsOneObjectWithEveryFinding) {
  google::protobuf::Struct parsed;
  const std::string json = diagnosis_json(kDiagnosis);
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(json, &parsed).ok()) << json;
  EXPECT_EQ(parsed.fields().at("failures").number_value(), 1.0);
  EXPECT_EQ(parsed.fields().at("warnings").number_value(), 1.0);
  const auto& findings = parsed.fields().at("findings").list_value();
  ASSERT_EQ(findings.values_size(), 3);
  EXPECT_EQ(findings.values(1).struct_value().fields().at("text").string_value(), "so \"so\"");
  const auto& third = findings.values(2).struct_value().fields();
  EXPECT_EQ(third.at("section").string_value(), "There");
  EXPECT_EQ(third.at("verdict").string_value(), "failure");
  EXPECT_EQ(third.at("histogram").list_value().values_size(), 2);
}

}  // namespace
}  // namespace longreach::finding_test
