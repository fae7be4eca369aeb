#include "deploy/lab/solve/solve_identify.hpp"

#include <istream>
#include <optional>
#include <ostream>

#include "common/text/utf8.hpp"
#include "deploy/lab/contact_convention.hpp"
#include "deploy/lab/contact_table.hpp"
#include "deploy/lab/estimators/methods.hpp"
#include "deploy/lab/solve/solve_json.hpp"
#include "slave/estimation/watched_identifier.hpp"

namespace longreach {
namespace {

using solve_json::BadRequest;
using OrderedJson = nlohmann::ordered_json;

/// Converts rows to samples with a speed.
class Feed {
 public:
  void step(const ContactRow& row, std::vector<WatchedIdentifier>& identifiers) {
    if (row.v_m_per_s) {
      give({row.x_m, *row.v_m_per_s, row.f_n}, row.t_s, identifiers);
    } else if (rows_ >= 2) {
      // The derivative, at the previous row, of the parabola through the last three rows.
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

  ContactRow first_, before_;
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
  for (const Verdict group :
       {Verdict::kIdentified, Verdict::kNotYet, Verdict::kNotIdentifiable, Verdict::kNoPowerLaw}) {
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

OrderedJson to_json(const ContactAnswer& answer) {
  OrderedJson values, sd;
  for (const Named& n : kNamed) {
    const Identified& p = answer.*n.value;
    const bool reported =
        answer.valid && p.verdict != Verdict::kNotIdentifiable && p.verdict != Verdict::kNoPowerLaw;
    values[n.name] = reported ? OrderedJson(p.value) : OrderedJson(nullptr);
    sd[n.name] = answer.valid ? OrderedJson(p.sd) : OrderedJson(nullptr);
  }
  values["sd"] = sd;
  values["verdict"] = verdict(answer);
  return values;
}

/// The answer at the depth that is asked for, or, where the tool hardly presses, at the largest depth.
ContactAnswer answer_of(WatchedIdentifier& identifier, const IdentifyOptions& options, bool free) {
  constexpr double kNearSurface = 0.02;
  const ContactAnswer now = identifier.answer();
  if (options.depth_m) return identifier.reported().answer_at(*options.depth_m);
  const double deepest_m = identifier.reported().visited(1e9);
  return free || now.depth_m < kNearSurface * deepest_m ? identifier.reported().answer_at(deepest_m) : now;
}

std::vector<Method> methods(const std::string& estimator) {
  if (const auto method = method_of(estimator)) return {*method};
  return {std::begin(kAllMethods), std::end(kAllMethods)};
}

}  // namespace

std::vector<std::string> identify_estimators() {
  std::vector<std::string> names;
  for (const Method method : kAllMethods) names.emplace_back(name_of(method));
  names.emplace_back("all");
  return names;
}

int solve_identify(const IdentifyOptions& options, std::istream& in, std::ostream& out,
                   std::ostream& errors) {
  const std::vector<Method> chosen = methods(options.estimator);
  std::vector<WatchedIdentifier> identifiers;
  for (const Method method : chosen)
    identifiers.push_back(by<WatchedIdentifier>(method, {.exponent = options.exponent,
                                                         .force_noise_n = options.force_noise_n,
                                                         .position_noise_m = options.position_noise_m}));
  ContactTable table;
  ContactConvention convention;
  Feed feed;
  std::string line;
  double t_s = 0.0;
  bool free = true;
  const auto refuse = [&errors](const std::string& why) {
    errors << "longreach-lab: " << printable(why) << '\n';
    return 2;
  };
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    try {
      const auto row = table.read(line);
      if (!row) continue;
      convention.step(*row, table.time_has_unit());
      t_s = row->t_s;
      free = !(row->x_m > 0.0);
      feed.step(*row, identifiers);
    } catch (const BadRequest& e) {
      return refuse("line " + std::to_string(number) + ": " + e.what());
    }
    if (options.estimator == "all") continue;
    OrderedJson answer{{"t", t_s}};
    answer.update(to_json(answer_of(identifiers.front(), options, free)));
    out << answer << '\n' << std::flush;
  }
  try {
    convention.require(table.x_has_unit());
  } catch (const BadRequest& e) {
    return refuse(e.what());
  }
  if (!convention.touches())
    errors << "longreach-lab: no sample has a positive \"x\", so there is no contact; x is the "
              "penetration, which is 0 or negative in free space\n";
  for (std::size_t i = 0; options.estimator == "all" && i < chosen.size(); ++i) {
    OrderedJson answer{{"estimator", name_of(chosen[i])}, {"t", t_s}};
    answer.update(to_json(answer_of(identifiers[i], options, true)));
    out << answer << '\n';
  }
  return 0;
}

}  // namespace longreach
