#pragma once
// A snapshot of a contact over a link to the Moon.

#include <string>

#include "master/console/situation.hpp"
#include "master/console/snapshot.hpp"
#include "master/console/terminal_view.hpp"
#include "master/console/words.hpp"

namespace longreach {

inline ConsoleSnapshot touching() {
  ConsoleSnapshot s;
  s.seconds = 21.26;
  s.seconds_left = 38.74;
  s.operator_phase = "press";
  s.view.state = s.view.far_state = SafetyState::kEngaged;
  s.view.far_known = true;
  s.view.scale = 0.8;
  s.view.kv_per_s = 2.0;
  s.view.p_MH = Vector3(0.0123, -0.0005, 0.0);
  s.view.goal_m = Vector3(0.00984, -0.0004, 0.0);
  s.view.in_contact = true;
  s.view.stiffness_n_per_m = s.view.surface_n_per_m = 981.0;
  s.view.F_H_M.force = Vector3(-3.0, 0.0, 0.0);
  s.view.spring_force_n = Vector3(-3.0, 0.0, 0.0);
  s.view.port_energy_j = 4.6e-3;
  s.view.port_energy_min_j = -1.2e-4;
  s.view.far.X_WE.p = Vector3(9.8123, 0.0, 4.25);
  s.view.far.F_E_W.force = Vector3(-2.9, 0.0, 0.0);
  s.view.far.estimate.stiffness_n_per_m = 1002.0;
  s.view.far.estimate.stiffness_sd_n_per_m = 5.01;
  s.view.far.estimate.n = 1.5;
  s.view.far.estimate.n_sd = 0.02;
  s.view.far.estimate.n_verdict = Verdict::kIdentified;
  s.view.far.estimate.lambda_verdict = Verdict::kNotIdentifiable;
  s.view.far.estimate.valid = true;
  s.link.rtt_s = 2.602;
  s.link.jitter_s = 0.0101;
  s.link.loss = 0.012;
  s.link.age_s = 2.62;
  s.link.silence_s = 0.021;
  return s;
}

inline std::string happening(const ConsoleSnapshot& s) { return sentence_of(situation_of(s), s); }

inline std::string page(ConsoleSnapshot s, int width, bool color, int rows = 1000) {
  s.shown = {situation_of(s), happening(s), clamps_in_words(s.view)};
  return render(s, width, color, rows);
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace longreach
