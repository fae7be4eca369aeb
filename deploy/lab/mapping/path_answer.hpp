#pragma once
// The answer of the experiment `path-task`, with the names of its metrics (deploy/lab/report/answer.hpp).

namespace longreach {

constexpr const char* kPathTaskAnswer =
    "The path is {reaches} times the reach of the handle long. At a round trip of 2.6 s, {operators} "
    "simulated operators need {rate_time_s_at_2.6} s in rate mode (path error {rate_error_m_at_2.6*1e3} "
    "mm), {position_time_s_at_2.6} s in position mode ({position_error_m_at_2.6*1e3} mm) and "
    "{hybrid_time_s_at_2.6} s in hybrid mode ({hybrid_error_m_at_2.6*1e3} mm). Hybrid mode is faster "
    "than position mode at {hybrid_gains_on_position_delays} of 4 delays (p < 0.05 at "
    "{hybrid_gains_on_position_delays_surely}; at 2.6 s, the worst operator gains "
    "{hybrid_gains_on_position_least_at_2.6} s) and more accurate than rate mode at "
    "{hybrid_gains_on_rate_delays} of 4 (p < 0.05 at {hybrid_gains_on_rate_delays_surely}). On a path "
    "twice as long, it is faster at {large_hybrid_gains_on_position_delays} of 2 delays (p < 0.05 at "
    "{large_hybrid_gains_on_position_delays_surely}; the worst operator gains "
    "{large_hybrid_gains_on_position_least_at_2.6} s). With a ghost at 2.6 s, hybrid mode gains "
    "{ghost_hybrid_gains_on_position_at_2.6} s on position mode, on the long path "
    "{large_ghost_hybrid_gains_on_position_at_2.6} s. If the other handle turns meanwhile, the goal "
    "turns by {both_turned_rad*1e3} mrad, or by {translation_turned_rad*1e3} mrad if only the "
    "translation is transferred.";

}  // namespace longreach
