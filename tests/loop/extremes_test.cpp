// Every cell of the experiment `extremes`: stable and accurate, or refused with a message.
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <ostream>
#include <stdexcept>

#include "tests/experiments/extremes/extremes.hpp"

namespace longreach {
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

class Extremes : public testing::TestWithParam<At> {};

TEST_P(Extremes, IsStableOrRefused) {
  const auto& [row, cell] = GetParam();
  const ExtremeResult result = judge(*cell, 1);
  EXPECT_NE(result.outcome, ExtremeOutcome::kBad)
      << row->quantity << ", " << cell->value << ": " << result.words;
  EXPECT_EQ(result.words.empty(), result.outcome == ExtremeOutcome::kStable) << "refused without a word";
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
  return name + "_" + std::to_string(at.param.cell - at.param.row->cells.data());
}

INSTANTIATE_TEST_SUITE_P(Cells, Extremes, testing::ValuesIn(all_cells()), name_of);

TEST(ExtremeJudge, CallsAnErrorThatIsNoNumberBad) {
  EXPECT_EQ(accurate(0.5, 1.0).outcome, ExtremeOutcome::kStable);
  for (const double error : {2.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_EQ(accurate(error, 1.0).outcome, ExtremeOutcome::kBad) << error;
  EXPECT_EQ(
      judge({"", [](std::uint64_t) -> ExtremeResult { throw std::runtime_error("broken"); }}, 1).outcome,
      ExtremeOutcome::kBad);
}

}  // namespace
}  // namespace longreach
