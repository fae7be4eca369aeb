// What the slave learns of a contact: the identifier against the law that made the samples, with 0.05 N of
// noise, pressed with 10 N at the most.

#include <cmath>
#include <limits>

#include "common/text/number_text.hpp"
#include "deploy/lab/contact/contact_record.hpp"
#include "slave/estimation/identifier.hpp"
#include "tests/extremes/extremes.hpp"

namespace longreach {
namespace {

struct Recording {
  test::ContactCell contact{};
  EstimatorKind kind = EstimatorKind::kMaximumLikelihood;
  double period_s = 1e-3;
  double affected = 0.0;  // takes the place of every seventh force, if it is not zero
  double gain = 1.0;      // of the force sensor; it is taken for 1
};

ExtremeResult identify(const Recording& what, std::uint64_t seed) {
  IdentifierConfig config{.kind = what.kind, .exponent = what.contact.n};
  Identifier identifier(config);
  identifier.begin();
  Random random = Random(seed).child("extremes");
  const int samples = std::max(2000, static_cast<int>(2.0 / what.period_s));
  int affected = 0;
  for (int i = 0; i < samples; ++i) {
    PenetrationSample s = test::motion(what.contact.excitation, what.period_s * i);
    s.x_m *= what.contact.deepest_m();
    s.v_m_per_s *= what.contact.deepest_m();
    s.force_n = what.gain * what.contact.force(s.x_m, s.v_m_per_s) + what.contact.noise_n * random.normal();
    if (what.affected != 0.0 && i % 7 == 3) s.force_n = what.affected, ++affected;
    identifier.step(s, what.period_s);
  }
  if (identifier.ignored() != static_cast<std::uint64_t>(affected))
    return bad(std::to_string(identifier.ignored()) + " samples ignored, " + std::to_string(affected) +
               " were spoilt");
  const ContactAnswer answer = identifier.answer();
  if (!answer.valid || answer.stiffness.verdict != Verdict::kIdentified)
    return refused("stiffness: " + std::string(text_of(answer.stiffness.verdict)));
  const test::ContactCell& c = what.contact;
  const double tangent = c.n * c.k * std::pow(answer.depth_m, c.n - 1.0);
  return accurate(std::abs(answer.stiffness.value / tangent - 1.0), kNoticed);
}

template <class Set>
ExtremeRow estimate_row(const std::string& quantity, const std::string& unit,
                        std::initializer_list<double> values, const Set& set) {
  const auto cell = [&set](const std::string& name, double value, double gain) {
    return ExtremeCell{name, "", [set, value, gain](std::uint64_t seed) {
                         Recording what{.gain = gain};
                         set(what, value);
                         return identify(what, seed);
                       }};
  };
  ExtremeRow row{"identification: " + quantity,
                 "error of the tangent stiffness",
                 cell("a sensor of gain 1.2", *values.begin(), 1.2),
                 {}};
  for (const double value : values) row.cells.push_back(cell(short_text(value) + unit, value, 1.0));
  return row;
}

}  // namespace

std::vector<ExtremeRow> extreme_estimates() {
  std::vector<ExtremeRow> rows;
  for (const double n : {1.0, 1.5, 3.0}) {
    for (const EstimatorKind kind : {EstimatorKind::kMaximumLikelihood, EstimatorKind::kFixedExponent}) {
      rows.push_back(estimate_row(std::string(name_of(kind)) + ", stiffness, n = " + format_number(n), "",
                                  {1e0, 1e2, 1e3, 1e5, 1e7, 1e9}, [n, kind](Recording& what, double k) {
                                    what.kind = kind;
                                    what.contact.k = k;
                                    what.contact.n = n;
                                  }));
    }
  }
  rows.push_back(estimate_row("damping λ/k", "", {0.0, 0.1, 10.0, 100.0},
                              [](Recording& what, double a) { what.contact.a = a; }));
  rows.push_back(estimate_row("sample time", " s", {2e-5, 1e-3, 5e-2},
                              [](Recording& what, double period_s) { what.period_s = period_s; }));
  constexpr double inf = std::numeric_limits<double>::infinity();
  rows.push_back(estimate_row("every seventh force", " N",
                              {std::numeric_limits<double>::quiet_NaN(), inf, -inf, 1e300},
                              [](Recording& what, double force_n) { what.affected = force_n; }));
  return rows;
}

}  // namespace longreach
