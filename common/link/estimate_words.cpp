#include "common/link/estimate_words.hpp"

#include <charconv>
#include <cmath>

namespace longreach {
namespace {

constexpr double kApart = 0.9;     // correlation above which two parameters are not identifiable separately
constexpr double kGivenSd = 1e-5;  // standard deviation of n below which n was given instead of estimated

std::string number(double value, int digits) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
  return {text, end};
}

std::string percent(double share) { return number(100.0 * share, 2) + " %"; }

std::string judged(Verdict verdict, const std::string& known, const std::string& name) {
  switch (verdict) {
    case Verdict::kIdentified:
      return known;
    case Verdict::kNotYet:
      return name + " not yet known";
    case Verdict::kNotIdentifiable:
    case Verdict::kNoPowerLaw:
      break;
  }
  return name + " not identifiable";
}

}  // namespace

std::string stiffness_in_words(const ContactEstimate& e, std::string_view unit) {
  if (!e.valid) return "";
  return number(e.stiffness_n_per_m, 3) + " " + std::string(unit) + " within " +
         percent(e.stiffness_sd_n_per_m / e.stiffness_n_per_m);
}

std::string law_in_words(const ContactEstimate& e) {
  if (!e.valid) return "";
  if (e.n_verdict == Verdict::kNoPowerLaw) return "no power law fits";
  const std::string n =
      "n " + number(e.n, 3) + (e.n_sd < kGivenSd ? " as given" : " within " + number(e.n_sd, 2));
  const std::string lambda =
      "lambda/k " + number(e.lambda / e.k, 3) + " s/m within " + percent(e.lambda_sd / std::abs(e.lambda));
  const bool mixed = e.lambda_verdict != Verdict::kIdentified && std::abs(e.correlation) > kApart;
  return judged(e.n_verdict, n, "n") + ", " + judged(e.lambda_verdict, lambda, "lambda") +
         (mixed ? " separately from k" : "");
}

std::string in_words(const GripperState& gripper) {
  if (!gripper.closed) return gripper.holds ? "open, but holds an object" : "open";
  if (!gripper.holds) return "closed";
  if (!(gripper.load_sd_kg > 0.0)) return "closed, holds an object";
  return "closed, holds " + number(gripper.load_kg, 3) + " kg (standard deviation " +
         number(gripper.load_sd_kg, 2) + ")";
}

}  // namespace longreach
