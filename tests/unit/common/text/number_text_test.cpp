#include "common/text/number_text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "common/core/random.hpp"

namespace longreach::number_text_test {
namespace {

TEST(NumberText, PrintsPlainDigitsWhereTheyAreEasyToRead) {
  EXPECT_EQ(format_number(0.0), "0");
  EXPECT_EQ(format_number(-0.0), "-0");
  EXPECT_EQ(format_number(0.8), "0.8");
  EXPECT_EQ(format_number(20000.0), "20000");
  EXPECT_EQ(format_number(1e5), "100000");
  EXPECT_EQ(format_number(1e-4), "0.0001");
  EXPECT_EQ(format_number(1.27e-4), "0.000127");
  EXPECT_EQ(format_number(1e-10), "1e-10");
  EXPECT_EQ(format_number(1e-5), "1e-5");
  EXPECT_EQ(format_number(-1.5e12), "-1.5e12");
  EXPECT_EQ(format_number(std::nan("")), "nan");
  EXPECT_EQ(format_number(-std::numeric_limits<double>::infinity()), "-inf");
}

// Oracle: strtod, another parser.
TEST(NumberText, ParsesBackToTheSameBits) {
  Random random(7);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(random.next());
    if (!std::isfinite(value)) continue;
    const std::string text = format_number(value);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)),
              std::bit_cast<std::uint64_t>(value))
        << text;
    ASSERT_EQ(parse_number(text), value) << text;
  }
  for (const double value : {5e-324, 2.2250738585072014e-308, 1.7976931348623157e308, 0.1 + 0.2}) {
    EXPECT_EQ(parse_number(format_number(value)), value);
  }
}

TEST(NumberText, RefusesWhatIsNotAWholeFiniteDecimalNumber) {
  for (const char* text :
       {"",         " ",     " 1",     "1 ", "+1", "1x", "1,5", "0x10", "nan",   "NaN",   "inf", "-inf",
        "infinity", "1e999", "-1e999", "1e", "e5", ".",  "-",   "--1",  "1.2.3", "1_000", "½"}) {
    EXPECT_FALSE(parse_number(text)) << "\"" << text << "\"";
  }
  EXPECT_FALSE(parse_number(std::string_view("1\0", 2)));
  EXPECT_EQ(parse_number("-1.5e-3"), -1.5e-3);
  EXPECT_EQ(parse_number(".5"), 0.5);
}

TEST(NumberText, TakesUnitsOfTime) {
  EXPECT_EQ(parse_seconds("650ms"), 0.65);
  EXPECT_EQ(parse_seconds("0.65s"), 0.65);
  EXPECT_EQ(parse_seconds("20us"), 2e-5);
  EXPECT_EQ(parse_seconds("0.1ms"), 1e-4);  // 0.1 / 1000 would be off by a bit
  EXPECT_EQ(parse_seconds("1e2ms"), 0.1);
  EXPECT_EQ(parse_seconds("3"), 3.0);
  for (const char* text :
       {"ms", "s", "1 ms", "1min", "1mss", "1ns", "infs", "nans", "1e999ms", "0x1s", "5%"}) {
    EXPECT_FALSE(parse_seconds(text)) << text;
  }
}

TEST(NumberText, TakesPercent) {
  EXPECT_EQ(parse_fraction("2%"), 0.02);
  EXPECT_EQ(parse_fraction("99.5%"), 0.995);
  EXPECT_EQ(parse_fraction("0.3"), 0.3);
  for (const char* text : {"%", "2%%", "2 %", "%2", "2ms", "inf%"})
    EXPECT_FALSE(parse_fraction(text)) << text;
}

TEST(NumberText, ParsesWholeNumbersWithinTheirType) {
  EXPECT_EQ(parse_integer<std::uint32_t>("4294967295"), 4294967295U);
  EXPECT_EQ(parse_integer<std::uint32_t>("010"), 10U);
  for (const char* text : {"4294967296", "-1", "1.0", "1e3", "", "0x1", " 1", "1 "}) {
    EXPECT_FALSE(parse_integer<std::uint32_t>(text)) << text;
  }
}

}  // namespace
}  // namespace longreach::number_text_test
