#include "deploy/lab/solve/solve_impact.hpp"

#include <cmath>

#include "deploy/lab/contact/free_impact.hpp"

namespace longreach {
namespace {

using solve_json::BadRequest;
using solve_json::Json;

constexpr double kStepsPerContact = 64.0;  // penetration and time of separation are then right within 1 %

double positive(const Json& request, const std::string& key) {
  const double x = solve_json::number(request, key);
  if (!(x > 0.0)) throw BadRequest("\"" + key + "\" must be greater than 0");
  return x;
}

Integrator integrator(const Json& request) {
  if (!request.contains("integrator")) return Integrator::kDiscreteGradient;
  const std::string word = solve_json::text(request, "integrator");
  std::string known;
  for (const NamedIntegrator& one : kIntegrators) {
    if (one.name == word) return one.integrator;
    known += (known.empty() ? "" : ", ") + std::string(one.name);
  }
  throw BadRequest("\"integrator\" = \"" + word + "\" is not one of " + known);
}

FreeImpact read(const Json& request) {
  FreeImpact impact;
  impact.contact.mass_kg = positive(request, "m");
  HuntCrossley& law = impact.contact.law;
  law.k = positive(request, "k");
  law.n = solve_json::number(request, "n");
  if (!(law.n >= 1.0 && law.n <= 3.0)) throw BadRequest("\"n\" must be between 1 and 3");
  const double lambda = solve_json::number(request, "lambda");
  if (!(lambda >= 0.0)) throw BadRequest("\"lambda\" must not be negative");
  law.a = lambda / law.k;
  impact.speed_m_per_s = positive(request, "v");
  const double duration_s = contact_time_s(impact.contact, impact.speed_m_per_s);
  impact.dt = request.contains("dt") ? positive(request, "dt") : duration_s / kStepsPerContact;
  impact.integrator = integrator(request);
  if (!std::isfinite(law.a) || !std::isfinite(duration_s) || !(duration_s > 0.0) || !(impact.dt > 0.0))
    throw BadRequest("the values differ too much in magnitude to compute the impact");
  if (!(duration_s / impact.dt < static_cast<double>(kFreeImpactSteps)))
    throw BadRequest("\"dt\" is too short: the impact lasts about " + Json(duration_s).dump() +
                     " s and would take more than " + std::to_string(kFreeImpactSteps) + " steps");
  return impact;
}

}  // namespace

Json solve_impact(const Json& request) {
  solve_json::require_known(request, "", {"m", "k", "lambda", "n", "v", "dt", "integrator"});
  const FreeImpactOutcome out = run_free_impact(read(request));
  if (!out.left)
    throw BadRequest(
        "the computation overflows, or the mass does not separate from the surface within the maximum "
        "number of steps");
  return {{"restitution", out.restitution},
          {"penetration_max", out.penetration_max_m},
          {"contact_time", out.contact_time_s},
          {"energy_error", out.energy_error},
          {"evaluations", out.evaluations}};
}

}  // namespace longreach
