#include "tests/experiments/solve_identify.hpp"

#include <gtest/gtest.h>

#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/property/contact_record.hpp"

namespace longreach {
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

TEST(SolveIdentify, SummarisesAllEstimators) {
  IdentifyOptions options;
  options.estimator = "all";
  const Result r = run(text(record(), Format::kCsv, true), options);
  ASSERT_EQ(r.lines.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(r.lines[i]["estimator"], identify_estimators()[i]);
}

TEST(SolveIdentify, NamesLineFieldAndReasonOfWhatItCannotRead) {
  const std::pair<const char*, const char*> cases[] = {
      {"t,x,f\n0,1,2\n0.1,1,soft\n", "line 3: \"f\" must be a number, not \"soft\""},
      {"t,x,f\n0,1,2\n0.1,1\n", "line 3: 2 values for 3 columns"},
      {"t,x,f\n0,1,nan\n", "line 2: \"f\" is not a finite number"},
      {"t,y,f\n", "line 1: unknown column \"y\"; the header may have t, x, v and f"},
      {"t,x\n", "line 1: column \"f\" is missing"},
      {"t,x,x,f\n", "line 1: column \"x\" is there twice"},
      {"{\"t\": 0, \"x\": 1}\n", "line 1: key \"f\" is missing"},
      {"\n{\"t\": 0, \"x\": 1, \"f\": \"2\"}\n", "line 2: \"f\" must be a number"},
      {"{\"t\": 0, \"x\": 1, \"f\": 2, \"z\": 3}\n", "line 1: unknown key \"z\""},
      {"{\"t\": 0, \"x\": 1, \"f\": 2}\n{\"t\": 0, \"x\": 1, \"f\": 2}\n", "line 2: \"t\" does not rise"},
      {"{\"t\": 0, \"x\": 1, \"f\": 2}\n{\"t\": 1, \"x\": 1, \"f\": 2, \"v\": 0}\n",
       "line 2: \"v\" is there, which the lines before do not have"},
      {"{\"t\": 0, \"x\": 1, \"f\": 2}\nt,x,f\n", "line 2: not JSON"},
  };
  for (const auto& [input, reason] : cases) {
    const Result r = run(input);
    EXPECT_EQ(r.status, 2) << input;
    EXPECT_NE(r.errors.find(reason), std::string::npos) << r.errors << reason;
  }
}

TEST(SolveIdentify, TakesNothingForNothing) {
  EXPECT_EQ(run("").status, 0);
  EXPECT_EQ(run("t,x,f\n").lines.size(), 0u);
}

}  // namespace
}  // namespace longreach
