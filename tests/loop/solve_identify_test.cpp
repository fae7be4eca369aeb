#include "deploy/lab/solve/solve_identify.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>
#include <vector>

#include "deploy/lab/contact/contact_record.hpp"

namespace longreach::solve_identify_test {
namespace {

using nlohmann::json;

enum class Format { kJson, kCsv };

std::string text(const std::vector<PenetrationSample>& record, Format format, bool with_v) {
  std::ostringstream out;
  out << std::setprecision(17);
  if (format == Format::kCsv) out << (with_v ? "t, x, v, f\n" : "t,x,f\n");
  double t = 0.0;
  for (const PenetrationSample& s : record) {
    if (format == Format::kJson) {
      json line{{"t", t}, {"x", s.x_m}, {"f", s.force_n}};
      if (with_v) line["v"] = s.v_m_per_s;
      out << line << '\n';
    } else {
      out << t << ',' << s.x_m << ',';
      if (with_v) out << s.v_m_per_s << ',';
      out << s.force_n << "\r\n";
    }
    t += 1e-3;
  }
  return out.str();
}

struct Result {
  int status = 0;
  std::vector<json> lines;
  std::string errors;
};

Result run(const std::string& input, const IdentifyOptions& options = {}) {
  std::istringstream in(input);
  std::ostringstream out, errors;
  Result result;
  result.status = solve_identify(options, in, out, errors);
  result.errors = errors.str();
  std::istringstream answers(out.str());
  for (std::string line; std::getline(answers, line);) result.lines.push_back(json::parse(line));
  return result;
}

std::vector<PenetrationSample> record(double k = 1e4, double n = 1.5) {
  const test::ContactCell cell{k, n, 0.15, 0.05, test::Excitation::kTouchCycles};
  Random random(1);
  return test::with_noise(test::exact_record(cell), cell.noise_n, random);
}

TEST(SolveIdentify, AnswersEveryLineOfEitherFormatAlike) {
  const Result from_json = run(text(record(), Format::kJson, true));
  const Result from_csv = run(text(record(), Format::kCsv, true));
  EXPECT_EQ(from_json.status, 0);
  ASSERT_EQ(from_json.lines.size(), 2000u);
  EXPECT_EQ(from_json.lines, from_csv.lines);
  const json& last = from_json.lines.back();
  EXPECT_NEAR(last["t"], 1.999, 1e-9);
  EXPECT_NEAR(last["k"], 1e4, 300.0);
  EXPECT_NEAR(last["n"], 1.5, 0.01);
  EXPECT_NEAR(last["lambda"], 1500.0, 300.0);
  EXPECT_LT(last["sd"]["k"], 100.0);
  EXPECT_EQ(last["verdict"], "identified");
}

TEST(SolveIdentify, SaysNotYetAtFirstAndTheTangentLater) {
  const Result r = run(text(record(), Format::kJson, true));
  EXPECT_EQ(r.lines.front()["verdict"], "not yet");
  EXPECT_TRUE(r.lines.front()["k"].is_null());
  const auto exact = test::exact_record({1e4, 1.5, 0.15, 0.05, test::Excitation::kTouchCycles});
  const std::size_t deepest = 1666;
  EXPECT_NEAR(r.lines[deepest]["stiffness"], 1.5e4 * std::sqrt(exact[deepest].x_m), 15.0);
  EXPECT_NEAR(r.lines[deepest]["secant"], 1e4 * std::sqrt(exact[deepest].x_m), 10.0);
}

TEST(SolveIdentify, DerivesTheSpeedWhereThereIsNone) {
  const Result with = run(text(record(), Format::kCsv, true)),
               without = run(text(record(), Format::kCsv, false));
  ASSERT_EQ(without.lines.size(), 2000u);
  EXPECT_NEAR(without.lines.back()["k"], with.lines.back()["k"], 5.0);
  EXPECT_NEAR(without.lines.back()["lambda"], with.lines.back()["lambda"], 15.0);
}

TEST(SolveIdentify, NamesWhatIsNotIdentifiableInsteadOfANumber) {
  const json last = run(text(record(1e7), Format::kJson, true)).lines.back();
  EXPECT_EQ(last["verdict"], "identified: k, n, stiffness, secant; not identifiable: lambda");
  EXPECT_TRUE(last["lambda"].is_null());
  EXPECT_GT(last["sd"]["lambda"], 1e6);
}

// As MATLAB writes them.
TEST(SolveIdentify, ReadsCommentsThatBeginWithPercent) {
  const std::string table = text(record(), Format::kCsv, true);
  const Result plain = run(table), commented = run("% force test\n% 2024-01-01\n" + table + "% end\n");
  ASSERT_FALSE(plain.lines.empty());
  ASSERT_EQ(commented.lines.size(), plain.lines.size()) << commented.errors;
  EXPECT_EQ(commented.lines.back(), plain.lines.back());
}

// The recording ends in free space: the result is that of the deepest sample.
TEST(SolveIdentify, EvaluatesAtTheLargestDepthInFreeSpace) {
  std::vector<PenetrationSample> samples = record();
  IdentifyOptions options;
  options.depth_m = std::ranges::max(samples, {}, &PenetrationSample::x_m).x_m;
  for (int i = 0; i < 50; ++i) samples.push_back({1e-8, -1e-3, 0.0});
  for (int i = 0; i < 50; ++i) samples.push_back({-1e-3, 0.0, 0.0});
  const json last = run(text(samples, Format::kCsv, true)).lines.back();
  const json asked = run(text(samples, Format::kCsv, true), options).lines.back();
  ASSERT_TRUE(last["stiffness"].is_number()) << last;
  EXPECT_NEAR(last["stiffness"], asked["stiffness"], 1e-6 * asked["stiffness"].get<double>());
}

TEST(SolveIdentify, SummarisesAllEstimators) {
  IdentifyOptions options;
  options.estimator = "all";
  const Result r = run(text(record(), Format::kCsv, true), options);
  ASSERT_EQ(r.lines.size(), 7u);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(r.lines[i]["estimator"], identify_estimators()[i]);
}

TEST(SolveIdentify, NamesLineFieldAndReasonOfWhatItCannotRead) {
  const std::pair<const char*, const char*> cases[] = {
      {"t,x,f\n0,1,2\n0.1,1,soft\n", "line 3: \"f\" must be a number, not \"soft\""},
      {"t,x,f\n0,1,2\n0.1,1\n", "line 3: 2 values for 3 columns"},
      {"t,x,f\n0,1,nan\n", "line 2: \"f\" is not a finite number"},
      {"t,y,f\n", "line 1: unknown column \"y\"; remove columns other than t, x, v and f"},
      {"t,x [inch],f\n", "line 1: the unit \"inch\" of \"x [inch]\" is unknown; use m, mm or um"},
      {"0,0.1,3\n", "line 1: the first line must name the columns, for example t,x,f"},
      {"t,x,f\n0,1,0,2,0,3\n",
       "line 2: 6 values for 3 columns; with decimal commas, separate the columns by"},
      {"t,x,f\n0,\"1,2\n", "line 2: a closing quotation mark is missing"},
      {"\xFF\xFEt,x,f\n", "line 1: the text is UTF-16; save it as UTF-8"},
      {"t,x,f\r0,1,2\r", "line 1: lines end with CR only"},
      {"t,x\n", "line 1: column \"f\" is missing"},
      {"t,x,x,f\n", "line 1: column \"x\" is given twice"},
      {"{\"t\": 0, \"x\": 1}\n", "line 1: key \"f\" is missing"},
      {"\n{\"t\": 0, \"x\": 1, \"f\": \"2\"}\n", "line 2: \"f\" must be a number"},
      {"{\"t\": 0, \"x\": 1, \"f\": 2, \"z\": 3}\n", "line 1: unknown key \"z\""},
      {"{\"t\": 0, \"x\": 1, \"f\": 2}\n{\"t\": 0, \"x\": 1, \"f\": 2}\n", "line 2: \"t\" does not increase"},
      {"{\"t\": 0, \"x\": 1, \"f\": 2}\n{\"t\": 1, \"x\": 1, \"f\": 2, \"v\": 0}\n",
       "line 2: key \"v\" is given, although the previous lines do not have it"},
      {"{\"t\": 0, \"x\": 1, \"f\": 2}\nt,x,f\n", "line 2: invalid JSON"},
      {"LabVIEW Measurement\t\n", "delete all lines up to the last ***End_of_Header***"},
      {"X_Value\tx\tf\tComment\n",
       "line 1: unknown columns \"X_Value\" (the time in LabVIEW files; name it t), \"Comment\"; remove columns other than"},
      {"Instrument,Press 3000\nOperator,NN\nt,x,f\n",
       "line 1: this line does not name the columns t, x and f, but contains \"Instrument\", \"Press 3000\"; delete all "
       "lines before the one that names the columns, or begin them with #"},
      {"t,x,f,temp,run\n",
       "line 1: unknown columns \"temp\", \"run\"; remove columns other than t, x, v and f"},
      {"\"t\" \"x\" \"f\"\n\"1\" 0 1 2\n",
       "line 2: 4 values for 3 columns; name all columns (R: write.table"},
      {"t,x,f\n0,1,NA\n", "\"f\" must be a number, not \"NA\"; remove the lines that lack a value"},
      {"t,x,f\n0,1,\n", "\"f\" must be a number, not \"\"; remove the lines that lack a value"},
      {"t,x,f\n0,1,NaN\n", "\"f\" is not a finite number; remove the lines that lack a value"},
      {"t;x;f\n0;1;-2.000,5\n", "not \"-2.000,5\"; write numbers without thousands separators"},
      {"t,x,f\n0,1,\"2,000.5\"\n", "not \"2,000.5\"; write numbers without thousands separators"},
      {"t,x,f\n2024-03-01 12:00:00,1,2\n", "write times in seconds since any fixed instant"},
      {"t,x,f\n0.5,1,2\n0.5,1,2\n",
       "line 3: \"t\" does not increase: 0.5 s after 0.5 s; sort the lines by t and remove lines with"},
      {"[{\"t\": 0, \"x\": 1, \"f\": 2},\n",
       "line 1: a JSON array is not supported; write one object per line"},
      {"t [s];x [\xb5m];f [N]\r\n", "line 1: the text is not UTF-8: \"t [s];x [\\xb5m];f [N]\"; save it as"},
      {"t,x,f\n0,\x1b[2J,3\n", "line 2: \"x\" must be a number, not \"\\x1b[2J\""},
      {"", "there are no samples; write a header such as t,x,f, followed by lines of numbers"},
      {"t,x,f\n", "there are no samples; write a header such as t,x,f, followed by lines of numbers"},
  };
  for (const auto& [input, reason] : cases) {
    const Result r = run(input);
    EXPECT_EQ(r.status, 2) << input;
    EXPECT_NE(r.errors.find(reason), std::string::npos) << r.errors << reason;
  }
}

/// The record in a dialect: `header`, and each line by `row` of t, x and f.
template <class RowOf>
std::string dialect(const std::string& header, RowOf row) {
  std::ostringstream out;
  out << header;
  double t = 0.0;
  for (const PenetrationSample& s : record()) {
    out << row(t, s.x_m, s.force_n);
    t += 1e-3;
  }
  return out.str();
}

std::string digits(double value) {
  std::ostringstream out;
  out << std::setprecision(15) << value;
  return out.str();
}

std::string comma(double value) {
  std::string text = digits(value);
  std::ranges::replace(text, '.', ',');
  return text;
}

/// The record as programs write it.
std::vector<std::pair<std::string, std::string>> dialects() {
  const auto plain = [](double t, double x, double f) {
    return digits(t) + "," + digits(x) + "," + digits(f) + "\n";
  };
  const auto semicolons = [](double t, double x, double f) {
    return comma(t) + ";" + comma(x) + ";" + comma(f) + "\r\n";
  };
  const auto quoted = [](const std::string& cell) { return '"' + cell + '"'; };
  return {
      {"empty cells behind the last",
       dialect("t,x,f\n", [](double t, double x,
                             double f) { return digits(t) + "," + digits(x) + "," + digits(f) + ",,\n"; })},
      {"byte order mark", dialect("\xEF\xBB\xBFt,x,f\r\n", plain)},
      {"semicolons and decimal commas", dialect("t;x;f\r\n", semicolons)},
      {"a separator that the file names", dialect("\xEF\xBB\xBFsep=;\r\nt;x;f\r\n", semicolons)},
      {"tabs and empty cells", dialect("t\tx\tf\t\n",
                                       [](double t, double x, double f) {
                                         return digits(t) + "\t" + comma(x) + "\t" + digits(f) + "\t\n";
                                       }) +
                                   "\t\t\t\n\n"},
      {"quoted cells", dialect("\"t\",\"x\",\"f\"\n",
                               [&](double t, double x, double f) {
                                 return quoted(digits(t)) + "," + quoted(comma(x)) + ", " +
                                        quoted(digits(f)) + "\n";
                               })},
      {"signs", dialect("t,x,f\n",
                        [](double t, double x, double f) {
                          return "+" + digits(t) + "," + (x < 0.0 ? "\xE2\x88\x92" : "+") +
                                 digits(std::abs(x)) + "," + (f < 0.0 ? "" : "+") + digits(f) + "\n";
                        })},
      {"units", dialect("Time (ms), Penetration [mm], \"Force, kN\"\n",
                        [](double t, double x, double f) {
                          return digits(1e3 * t) + "," + digits(1e3 * x) + "," + digits(1e-3 * f) + "\n";
                        })},
      {"units in names", dialect("t_ns|x_um|f_mN\n",
                                 [](double t, double x, double f) {
                                   return digits(1e9 * t) + "|" + digits(1e6 * x) + "|" + digits(1e3 * f) +
                                          "\n";
                                 })},
      {"comments and spaces", dialect("# made by hand, today\n# t x f\n",
                                      [](double t, double x, double f) {
                                        return digits(t) + "   " + digits(x) + " " + digits(f) + "\n";
                                      })},
      {"a line of units", dialect("Time,Depth,Force\n[ms],[mm],[N]\n",
                                  [](double t, double x, double f) {
                                    return digits(1e3 * t) + "," + digits(1e3 * x) + "," + digits(f) + "\n";
                                  })},
      {"an index before the names", dialect(",t,x,f\n",
                                            [i = 0](double t, double x, double f) mutable {
                                              return std::to_string(i++) + "," + digits(t) + "," + digits(x) +
                                                     "," + digits(f) + "\n";
                                            })},
      {"keys with units", dialect("",
                                  [](double t, double x, double f) {
                                    return json{{"t_ms", 1e3 * t}, {"x", x}, {"f [N]", f}}.dump() + "\n";
                                  })},
  };
}

TEST(SolveIdentify, ReadsWhatSpreadsheetsWrite) {
  const double expected = run(text(record(), Format::kCsv, false)).lines.back()["k"];
  for (const auto& [name, input] : dialects()) {
    const Result r = run(input);
    EXPECT_EQ(r.status, 0) << name << ": " << r.errors;
    ASSERT_EQ(r.lines.size(), 2000u) << name;
    EXPECT_NEAR(r.lines.back()["k"], expected, 1e-3) << name;
  }
}

TEST(SolveIdentify, DetectsWrongUnitsOfTimeAndWrongSigns) {
  const auto scaled = [](double by_t, double by_x, double by_f) {
    return dialect("t,x,f\n", [=](double t, double x, double f) {
      return digits(by_t * t) + "," + digits(by_x * x) + "," + digits(by_f * f) + "\n";
    });
  };
  const std::pair<std::string, const char*> cases[] = {
      {scaled(1e3, 1, 1),
       "line 6: \"t\" increases by 1 per line, so it seems to be in ms; name the column \"t [ms]\""},
      {scaled(1e6, 1, 1), "seems to be in us"},
      {scaled(1e9, 1, 1), "seems to be in ns"},
      {scaled(1, -1, -1), "x and f are negative in contact"},
      {scaled(1, -1, 1), "the force increases where x is negative"},
      {scaled(1, 1, -1), "f decreases while x increases"}};
  for (const auto& [input, words] : cases) {
    const Result r = run(input);
    EXPECT_EQ(r.status, 2) << words;
    EXPECT_NE(r.errors.find(words), std::string::npos) << words << r.errors;
  }
  // Slow on purpose, and free space alone, with a sensor that has an offset.
  EXPECT_EQ(run("t [s],x,f\n0,1,2\n1,1,2\n2,1,2\n3,1,2\n4,1,2\n5,1,2\n").status, 0);
  EXPECT_EQ(run(dialect("t,x,f\n",
                        [](double t, double x, double) {
                          return digits(t) + "," + digits(-1e-3 - std::abs(x)) + "," +
                                 digits(-3.0 + 0.1 * std::sin(1e4 * t)) + "\n";
                        }))
                .status,
            0);
}

/// The record with x and f of the sample, and v where that is true.
std::string altered(const std::string& names, bool with_v, double by_x, double plus_x_m, double by_v,
                    double plus_f_n) {
  std::ostringstream out;
  out << names << "\n";
  double t = 0.0;
  for (const PenetrationSample& s : record()) {
    out << digits(t) << "," << digits(by_x * s.x_m + plus_x_m);
    if (with_v) out << "," << digits(by_v * s.v_m_per_s);
    out << "," << digits(s.force_n + plus_f_n) << "\n";
    t += 1e-3;
  }
  return out.str();
}

TEST(SolveIdentify, DetectsLengthsSpeedsForcesAndSurfacesOfAnotherKind) {
  const std::pair<std::string, const char*> cases[] = {
      {altered("t,x,f", false, 1e3, 0, 0, 0),
       "so it seems to be in mm; name the column \"x [mm]\", or \"x [m]\""},
      {altered("t,x,f", false, 1e6, 0, 0, 0), "so it seems to be in um; name the column \"x [um]\""},
      {altered("t,x,f", false, 1, 0.3, 0, 0), "the force starts at x = 0.30"},
      {altered("t,x,f", false, 1, -0.004, 0, 0), "the force starts at x = -0.00"},
      {altered("t,x,f", false, 1, 0, 0, 2), "f is 2 N in free space (x <= 0); subtract this offset from f"},
      {altered("t,x,v,f", true, 1, 0, -1, 0),
       "\"v\" is negative where \"x\" increases; change the sign of v"},
      {altered("t,x,v,f", true, 1, 0, 1e3, 0),
       "\"v\" is 1e+03 times the derivative of \"x\"; state the units"}};
  for (const auto& [input, words] : cases) {
    const Result r = run(input);
    EXPECT_EQ(r.status, 2) << words;
    EXPECT_NE(r.errors.find(words), std::string::npos) << words << " but " << r.errors;
  }
  EXPECT_EQ(run(altered("t,x [m],v,f", true, 1e3, 0, 1e3, 0)).status, 0) << "as it says";
}

// A press that keeps to the convention is never refused, whatever it presses on and however it does.
TEST(SolveIdentify, SaysThatNothingIsTouchedAndThatASecondTableBegins) {
  const Result free = run("t,x,f\n0,-0.003,0.01\n0.001,-0.002,-0.01\n");
  EXPECT_EQ(free.status, 0);
  EXPECT_NE(free.errors.find("no sample has a positive \"x\", so there is no contact"), std::string::npos)
      << free.errors;
  const Result twice = run("t,x,f\n0,0.001,1\n0.001,0.002,2\nt,x,f\n0,0.001,1\n");
  EXPECT_EQ(twice.status, 2);
  EXPECT_NE(twice.errors.find("line 4: \"t\" must be a number, not \"t\"; a second table starts here"),
            std::string::npos)
      << twice.errors;
}

TEST(SolveIdentify, RefusesNoContactThatKeepsToTheConvention) {
  for (const double n : {1.0, 1.5, 2.5}) {
    for (const double k : {1e3, 1e5, 1e7}) {
      for (const auto excitation :
           {test::Excitation::kProbe, test::Excitation::kTouchCycles, test::Excitation::kSine}) {
        const test::ContactCell cell{k, n, 0.15, 0.05, excitation};
        Random random(1);
        const Result r =
            run(text(test::with_noise(test::exact_record(cell), cell.noise_n, random), Format::kCsv, true));
        EXPECT_EQ(r.status, 0) << r.errors << " k " << k << " n " << n;
      }
    }
  }
}

TEST(SolveIdentify, TakesNamesAsMatlabAndRMakeThem) {
  for (const char* names : {"t_s_,x_m_,v_m_s_,f_N_", "t..s.,x..m.,v..m.s.,f..N."}) {
    const Result r = run(altered(names, true, 1, 0, 1, 0));
    EXPECT_EQ(r.status, 0) << r.errors;
    EXPECT_NEAR(r.lines.back()["n"], 1.5, 0.01);
  }
}

}  // namespace
}  // namespace longreach::solve_identify_test
