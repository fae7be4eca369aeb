#pragma once
// What happened during an attempt at a task, whichever task it is.

#include <algorithm>
#include <cstdint>
#include <iomanip>
#include <sstream>
#include <string>

#include "common/spatial/spatial.hpp"
#include "proto/control.pb.h"

namespace longreach {

struct Conduct {
  bool rate = false, position = false;  // modes that were used
  int repositionings = 0;               // uses of the clutch
  std::uint64_t holds = 0;
  double tool_force_max_n = 0.0, hand_force_max_n = 0.0;
  double rtt_s = 0.0, scale = 0.0, kv_per_s = 0.0;  // in the newest frame

  [[nodiscard]] const char* mode() const { return rate && position ? "hybrid" : rate ? "rate" : "position"; }
};

inline double norm_of(const recording::Vector& v) { return Vector3(v.x(), v.y(), v.z()).norm(); }

class ConductWatch {
 public:
  /// The attempt begins with this frame.
  void begin(const proto::Frame& frame) {
    conduct_ = {};
    holds_before_ = frame.view().holds();
    clutched_ = frame.view().clutched();
  }
  void step(const proto::Frame& frame) {
    const recording::MasterView& view = frame.view();
    Conduct& c = conduct_;
    (view.mode() == recording::RATE ? c.rate : c.position) = true;
    c.repositionings += view.clutched() && !clutched_;
    clutched_ = view.clutched();
    c.holds = view.holds() - holds_before_;
    c.tool_force_max_n = std::max(c.tool_force_max_n, norm_of(view.far().wrench().force_n()));
    c.hand_force_max_n = std::max(c.hand_force_max_n, norm_of(view.spring_force_n()));
    c.rtt_s = frame.link().rtt_s();
    c.scale = view.scale();
    c.kv_per_s = view.kv_per_s();
  }
  [[nodiscard]] const Conduct& conduct() const { return conduct_; }

 private:
  Conduct conduct_{};
  bool clutched_ = false;
  std::uint64_t holds_before_ = 0;
};

inline std::string fixed_digits(double value, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

inline std::string in_millimetres(double metres) { return fixed_digits(1e3 * metres, 1) + " mm"; }

/// The end of the sentence about an attempt.
inline std::string in_words(const Conduct& c) {
  return std::to_string(c.repositionings) + " repositionings, " + std::to_string(c.holds) +
         " holds; at most " + fixed_digits(c.tool_force_max_n, 1) + " N at the tool and " +
         fixed_digits(c.hand_force_max_n, 1) + " N at the hand";
}

}  // namespace longreach
