#include "tests/experiments/solve_identify.hpp"

#include <charconv>
#include <cmath>
#include <istream>
#include <optional>
#include <ostream>

#include "slave/estimation/watched_identifier.hpp"
#include "tests/experiments/solve_json.hpp"

namespace longreach {
namespace {

using solve_json::BadRequest;
using Json = nlohmann::ordered_json;

struct Row {
  double t_s = 0.0, x_m = 0.0, f_n = 0.0;
  std::optional<double> v_m_per_s;
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    result.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return result;
}

/// Lines of either format as rows.
class Recording {
 public:
  Row read(const std::string& line) {
    Row row = csv_.empty() ? from_json(line) : from_csv(line);
    if (rows_ > 0 && !(row.t_s > last_t_s_)) throw BadRequest("\"t\" does not rise");
    if (rows_ > 0 && row.v_m_per_s.has_value() != has_v_)
      throw BadRequest(has_v_ ? "key \"v\" is missing, which the lines before have"
                              : "\"v\" is there, which the lines before do not have");
    has_v_ = row.v_m_per_s.has_value();
    last_t_s_ = row.t_s;
    ++rows_;
    return row;
  }

  void header(const std::string& line) {
    csv_ = cells(line);
    for (std::size_t i = 0; i < csv_.size(); ++i) {
      const std::string& name = csv_[i];
      if (name != "t" && name != "x" && name != "v" && name != "f")
        throw BadRequest("unknown column \"" + name + "\"; the header may have t, x, v and f");
      for (std::size_t j = 0; j < i; ++j)
        if (csv_[j] == name) throw BadRequest("column \"" + name + "\" is there twice");
    }
    for (const char* name : {"t", "x", "f"})
      if (std::find(csv_.begin(), csv_.end(), name) == csv_.end())
        throw BadRequest("column \"" + std::string(name) + "\" is missing");
  }

 private:
  static Row from_json(const std::string& line) {
    const solve_json::Json object = solve_json::parse(line);
    solve_json::require_known(object, "", {"t", "x", "v", "f"});
    Row row{solve_json::number(object, "t"),
            solve_json::number(object, "x"),
            solve_json::number(object, "f"),
            {}};
    if (object.contains("v")) row.v_m_per_s = solve_json::number(object, "v");
    return row;
  }

  [[nodiscard]] Row from_csv(const std::string& line) const {
    const std::vector<std::string> values = cells(line);
    if (values.size() != csv_.size())
      throw BadRequest(std::to_string(values.size()) + " values for " + std::to_string(csv_.size()) +
                       " columns");
    Row row;
    for (std::size_t i = 0; i < values.size(); ++i) {
      double value = 0.0;
      const char* end = values[i].data() + values[i].size();
      const auto [stop, error] = std::from_chars(values[i].data(), end, value);
      if (error != std::errc{} || stop != end)
        throw BadRequest("\"" + csv_[i] + "\" must be a number, not \"" + values[i] + "\"");
      if (!std::isfinite(value)) throw BadRequest("\"" + csv_[i] + "\" is not a finite number");
      if (csv_[i] == "t") row.t_s = value;
      if (csv_[i] == "x") row.x_m = value;
      if (csv_[i] == "f") row.f_n = value;
      if (csv_[i] == "v") row.v_m_per_s = value;
    }
    return row;
  }

  std::vector<std::string> csv_;  // names of the columns; empty: JSON
  std::size_t rows_ = 0;
  bool has_v_ = false;
  double last_t_s_ = 0.0;
};

/// Turns rows into samples with a speed.
class Feed {
 public:
  void step(const Row& row, std::vector<WatchedIdentifier>& identifiers) {
    if (row.v_m_per_s) {
      give({row.x_m, *row.v_m_per_s, row.f_n}, row.t_s, identifiers);
    } else if (rows_ >= 2) {
      // The derivative at the row before of the parabola through three.
      const double h1 = before_.t_s - first_.t_s, h2 = row.t_s - before_.t_s;
      const double slope1 = (before_.x_m - first_.x_m) / h1, slope2 = (row.x_m - before_.x_m) / h2;
      give({before_.x_m, (slope1 * h2 + slope2 * h1) / (h1 + h2), before_.f_n}, before_.t_s, identifiers);
    }
    first_ = before_;
    before_ = row;
    ++rows_;
  }

 private:
  void give(const PenetrationSample& sample, double t_s, std::vector<WatchedIdentifier>& identifiers) {
    const double dt = given_ ? t_s - *given_ : 0.0;
    given_ = t_s;
    for (WatchedIdentifier& identifier : identifiers) identifier.step(sample, dt);
  }

  Row first_, before_;
  std::size_t rows_ = 0;
  std::optional<double> given_;
};

struct Named {
  const char* name;
  Identified ContactAnswer::*value;
};
constexpr Named kNamed[] = {{"k", &ContactAnswer::k},
                            {"lambda", &ContactAnswer::lambda},
                            {"n", &ContactAnswer::n},
                            {"stiffness", &ContactAnswer::stiffness},
                            {"secant", &ContactAnswer::secant}};

std::string verdict(const ContactAnswer& answer) {
  if (!answer.valid || answer.secant.verdict == Verdict::kNotYet)
    return std::string(text_of(Verdict::kNotYet));
  std::string text;
  for (const Verdict group : {Verdict::kIdentified, Verdict::kNotYet, Verdict::kNotIdentifiable}) {
    std::string names;
    std::size_t count = 0;
    for (const Named& n : kNamed) {
      if ((answer.*n.value).verdict != group) continue;
      names += (names.empty() ? "" : ", ") + std::string(n.name);
      ++count;
    }
    if (count == std::size(kNamed)) return std::string(text_of(group));
    if (count > 0) text += (text.empty() ? "" : "; ") + std::string(text_of(group)) + ": " + names;
  }
  return text;
}

Json to_json(const ContactAnswer& answer) {
  Json values, sd;
  for (const Named& n : kNamed) {
    const Identified& p = answer.*n.value;
    const bool told = answer.valid && p.verdict != Verdict::kNotIdentifiable;
    values[n.name] = told ? Json(p.value) : Json(nullptr);
    sd[n.name] = answer.valid ? Json(p.sd) : Json(nullptr);
  }
  values["sd"] = sd;
  values["verdict"] = verdict(answer);
  return values;
}

std::vector<EstimatorKind> kinds(const std::string& estimator) {
  EstimatorKind kind{};
  if (parse(estimator, kind)) return {kind};
  std::vector<EstimatorKind> all;
  for (const std::string& name : identify_estimators())
    if (parse(name, kind)) all.push_back(kind);
  return all;
}

}  // namespace

std::vector<std::string> identify_estimators() {
  std::vector<std::string> names;
  for (const EstimatorKind kind : kEstimatorKinds) names.emplace_back(name_of(kind));
  names.emplace_back("all");
  return names;
}

int solve_identify(const IdentifyOptions& options, std::istream& in, std::ostream& out,
                   std::ostream& errors) {
  const std::vector<EstimatorKind> chosen = kinds(options.estimator);
  std::vector<WatchedIdentifier> identifiers;
  for (const EstimatorKind kind : chosen)
    identifiers.emplace_back(
        IdentifierConfig{kind, options.exponent, 1.0, options.force_noise_n, options.position_noise_m});
  Recording recording;
  Feed feed;
  std::string line;
  bool begun = false;
  double t_s = 0.0;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    if (trimmed(line).empty()) continue;
    try {
      if (!begun && trimmed(line).front() != '{') {
        recording.header(line);
        begun = true;
        continue;
      }
      begun = true;
      const Row row = recording.read(line);
      t_s = row.t_s;
      feed.step(row, identifiers);
    } catch (const BadRequest& e) {
      errors << "longreach-lab: line " << number << ": " << e.what() << '\n';
      return 2;
    }
    if (options.estimator == "all") continue;
    Json answer{{"t", t_s}};
    answer.update(to_json(identifiers.front().answer()));
    out << answer << '\n' << std::flush;
  }
  for (std::size_t i = 0; options.estimator == "all" && i < chosen.size(); ++i) {
    Json answer{{"estimator", name_of(chosen[i])}, {"t", t_s}};
    answer.update(to_json(identifiers[i].answer()));
    out << answer << '\n';
  }
  return 0;
}

}  // namespace longreach
