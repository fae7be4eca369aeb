#pragma once
// What of a contact and of a load is known, how well, and what cannot be told, as an operator would say it.
// Pure.

#include <string>
#include <string_view>

#include "common/link/telemetry.hpp"

namespace longreach {

/// "1.02e+03 N/m within 0.5 %", one standard deviation; `unit` of the stiffness. Empty without an estimate.
std::string stiffness_in_words(const ContactEstimate& estimate, std::string_view unit);

/// "n 1.5 within 0.02, lambda cannot be told apart from k". Empty without an estimate.
std::string law_in_words(const ContactEstimate& estimate);

/// The gripper: open, closed, holds something, holds so many kg.
std::string in_words(const GripperState& gripper);

}  // namespace longreach
