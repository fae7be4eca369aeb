#include "common/link/estimate_words.hpp"

#include <cmath>
#include <cstdio>

namespace longreach {
namespace {

constexpr double kApart = 0.9;     // correlation of what cannot be told apart
constexpr double kGivenSd = 1e-5;  // of n: it was not estimated

template <class... Values>
std::string told(const char* format, Values... values) {
  char text[96];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::string judged(Verdict verdict, const std::string& known, const std::string& name) {
  switch (verdict) {
    case Verdict::kIdentified:
      return known;
    case Verdict::kNotYet:
      return name + " not yet known";
    case Verdict::kNotIdentifiable:
      break;
  }
  return name + " cannot be told";
}

}  // namespace

std::string stiffness_in_words(const ContactEstimate& e, std::string_view unit) {
  if (!e.valid) return "";
  const double share = e.stiffness_sd_n_per_m / e.stiffness_n_per_m;
  return told("%.3g ", e.stiffness_n_per_m) + std::string(unit) + told(" within %.2g %%", 100.0 * share);
}

std::string law_in_words(const ContactEstimate& e) {
  if (!e.valid) return "";
  const std::string n =
      e.n_sd < kGivenSd ? told("n %.3g as given", e.n) : told("n %.3g within %.2g", e.n, e.n_sd);
  const std::string lambda =
      told("lambda/k %.3g s/m within %.2g %%", e.lambda / e.k, 100.0 * e.lambda_sd / std::abs(e.lambda));
  const bool mixed = e.lambda_verdict != Verdict::kIdentified && std::abs(e.correlation) > kApart;
  return judged(e.n_verdict, n, "n") + ", " + judged(e.lambda_verdict, lambda, "lambda") +
         (mixed ? " apart from k" : "");
}

}  // namespace longreach
