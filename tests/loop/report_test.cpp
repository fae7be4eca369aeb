// What a report says of an experiment.
#include <gtest/gtest.h>

#include <stdexcept>

#include "deploy/lab/report/answer.hpp"
#include "deploy/lab/report/page.hpp"

namespace longreach::report_test {
namespace {

TEST(ReportAnswer, FiguresHaveThreeDigits) {
  EXPECT_EQ(figure(0.0), "0");
  EXPECT_EQ(figure(1003.54), "1004");
  EXPECT_EQ(figure(999.6), "1000");
  EXPECT_EQ(figure(99.96), "100");
  EXPECT_EQ(figure(0.35549), "0.355");
  EXPECT_EQ(figure(-0.00123456), "-0.00123");
  EXPECT_EQ(figure(4.8006e-15), "4.8e-15");
  EXPECT_EQ(figure(2.5e6), "2.5e+06");
}

TEST(ReportAnswer, PutsInMetricsAndTheirMultiples) {
  const std::vector<Metric> metrics = {{"depth_m", 0.0021, "m"}, {"runs", 12.0, ""}};
  EXPECT_EQ(answer("{runs} runs, {depth_m*1e3} mm", metrics), "12 runs, 2.1 mm");
  EXPECT_EQ(answer("", metrics), "");
}

TEST(ReportAnswer, RefusesWhatItCannotSay) {
  const std::vector<Metric> metrics = {{"depth_m", 0.0021, "m"}, {"step_us", 3.0, "", true}};
  for (const char* sentence : {"{depth}", "{depth_m*}", "{depth_m*2x}", "{depth_m", "{step_us}"})
    EXPECT_THROW(static_cast<void>(answer(sentence, metrics)), std::invalid_argument) << sentence;
}

TEST(PressWall, PlotTitleNotesThatDirectForceIsOmitted) {
  const Experiment& press = *find_experiment("press-wall");
  std::vector<Metric> metrics = {{"rtt_s", 2.6, "s"},
                                 {"wall_n_per_m", 1000.0, "N/m"},
                                 {"direct_limit_cycle", 1.0, ""},
                                 {"direct_port_energy_min_j", -21.0, "J"},
                                 {"direct_force_peak_n", 28.3, "N"}};
  const Plot alone = plots_of(press, metrics).front();
  EXPECT_EQ(alone.title, "Pressing on a wall of 1 N/mm over a round trip of 2.6 s");
  metrics.push_back({"wave_limit_cycle", 0.0, ""});
  const Plot all = plots_of(press, metrics).front();
  EXPECT_EQ(all.title, alone.title + "; direct force exceeds the axes: 28.3 N and -21000 mJ");
  for (std::size_t i = 0; i < all.panels.size(); ++i) {
    EXPECT_TRUE(alone.panels[i].curves.front().scales);
    EXPECT_FALSE(all.panels[i].curves.front().scales);
    EXPECT_TRUE(all.panels[i].curves.back().scales);
  }
}

TEST(ReportPage, HoldsEveryChapterAndSaysWhatFailed) {
  const Experiment good{"good", "Is a < b?", "", nullptr, nullptr, "Fig. 9", "by {gap} m"};
  const Experiment bad{"bad", "Does it run?", "", nullptr, nullptr, "", "never {gap}"};
  ReportChapter right{&good, "longreach-lab run good", "00ff", {{"gap", 0.25, "m"}}, {{"a gap", "<svg/>"}},
                      ""};
  ReportChapter wrong{&bad, "longreach-lab run bad", "00ff", {}, {}, "the disk is full"};
  const std::string page = report_page({"abc", "small campaigns", 1}, {right, wrong});
  for (const char* part :
       {"Is a &lt; b?", "by 0.25 m", "Reproduces Fig. 9", "data:image/svg+xml;base64,PHN2Zy8+\"",
        "longreach-lab run good", "Failed: the disk is full", "href=\"#bad\""})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(
      report_table({right, wrong}),
      "| `longreach-lab run ...` | question | answer |\n|---|---|---|\n| `good` | Is a < b? (Fig. 9) | by "
      "0.25 m |\n");
}

// Every answer can be said of what its experiment measures: a report would fail at the end of hours else.
TEST(ReportAnswer, EveryExperimentOfThePaperIsNamed) {
  std::string figures;
  for (const Experiment& e : experiments()) figures += std::string(e.figure) + ", ";
  for (const char* number : {"9", "10", "11", "12", "13", "14", "15", "16", "17", "18", "19", "20", "21"})
    EXPECT_NE((", " + figures).find(std::string(" ") + number + ","), std::string::npos) << number;
}

}  // namespace
}  // namespace longreach::report_test
