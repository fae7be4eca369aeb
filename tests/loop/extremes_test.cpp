// Every cell of the program `extremes` comes out as it says, and every row can come out bad.
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <ostream>
#include <stdexcept>

#include "tests/extremes/extremes.hpp"

namespace longreach::extremes_test {
namespace {

struct At {
  const ExtremeRow* row;
  const ExtremeCell* cell;
};

std::ostream& operator<<(std::ostream& out, const At& at) {
  return out << at.row->quantity << ", " << at.cell->value;
}

std::vector<At> all_cells() {
  std::vector<At> all;
  for (const ExtremeRow& row : extreme_rows()) {
    for (const ExtremeCell& cell : row.cells) all.push_back({&row, &cell});
  }
  return all;
}

std::vector<At> all_controls() {
  std::vector<At> all;
  for (const ExtremeRow& row : extreme_rows()) all.push_back({&row, &row.control});
  return all;
}

class Extremes : public testing::TestWithParam<At> {};

TEST_P(Extremes, IsStableOrRefusedAsItShallBe) {
  const auto& [row, cell] = GetParam();
  const ExtremeResult result = judge(*cell, 1);
  EXPECT_NE(result.outcome, ExtremeOutcome::kBad)
      << row->quantity << ", " << cell->value << ": " << result.words;
  EXPECT_EQ(result.outcome == ExtremeOutcome::kRefused, !cell->refusal.empty());
  EXPECT_EQ(result.words.empty(), result.outcome == ExtremeOutcome::kStable) << "refused without a word";
}

class ExtremeControls : public testing::TestWithParam<At> {};

TEST_P(ExtremeControls, AreBad) {
  const auto& [row, control] = GetParam();
  ASSERT_TRUE(control->run) << row->quantity << " has no control";
  const ExtremeResult result = judge(*control, 1);
  EXPECT_EQ(result.outcome, ExtremeOutcome::kBad)
      << row->quantity << ", " << control->value << ": " << result.accuracy << result.words;
}

/// Row and place in it; the value may have signs that a name must not have.
std::string name_of(const testing::TestParamInfo<At>& at) {
  std::string name;
  for (const char c : at.param.row->quantity) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      name += c;
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  const bool control = at.param.cell == &at.param.row->control;
  return name + (control ? "" : "_" + std::to_string(at.param.cell - at.param.row->cells.data()));
}

INSTANTIATE_TEST_SUITE_P(Cells, Extremes, testing::ValuesIn(all_cells()), name_of);
INSTANTIATE_TEST_SUITE_P(Rows, ExtremeControls, testing::ValuesIn(all_controls()), name_of);

TEST(ExtremeJudge, CallsAnErrorThatIsNoNumberBad) {
  EXPECT_EQ(accurate(0.5, 1.0).outcome, ExtremeOutcome::kStable);
  for (const double error : {2.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_EQ(accurate(error, 1.0).outcome, ExtremeOutcome::kBad) << error;
  EXPECT_EQ(accurate(1e300, HUGE_VAL).outcome, ExtremeOutcome::kBad) << "a bound without end";
}

TEST(ExtremeJudge, HoldsACellToTheOutcomeThatItExpects) {
  const auto judged = [](const std::string& refusal, const ExtremeResult& result) {
    return judge({"", refusal, [result](std::uint64_t) { return result; }}, 1).outcome;
  };
  EXPECT_EQ(judged("", accurate(0.0, 1.0)), ExtremeOutcome::kStable);
  EXPECT_EQ(judged("a word", refused("with a word in it")), ExtremeOutcome::kRefused);
  EXPECT_EQ(judged("", refused("with a word in it")), ExtremeOutcome::kBad);
  EXPECT_EQ(judged("a word", accurate(0.0, 1.0)), ExtremeOutcome::kBad);
  EXPECT_EQ(judged("another", refused("with a word in it")), ExtremeOutcome::kBad);
  const auto broken = [](std::uint64_t) -> ExtremeResult { throw std::runtime_error("broken"); };
  EXPECT_EQ(judge({"", "", broken}, 1).outcome, ExtremeOutcome::kBad);
}

}  // namespace
}  // namespace longreach::extremes_test
