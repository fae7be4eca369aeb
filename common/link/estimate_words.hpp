#pragma once
// The estimates of a contact and of a load as text for the operator: values, accuracy, and what is not identifiable.
// Pure.

#include <string>
#include <string_view>

#include "common/link/telemetry.hpp"

namespace longreach {

/// "1.02e+03 N/m within 0.5 %", one standard deviation; `unit` is that of the stiffness. Empty without an
/// estimate.
std::string stiffness_in_words(const ContactEstimate& estimate, std::string_view unit);

/// "n 1.5 within 0.02, lambda not identifiable apart from k". Empty without an estimate.
std::string law_in_words(const ContactEstimate& estimate);

/// State of the gripper: open, closed, holds something, holds a mass in kg.
std::string in_words(const GripperState& gripper);

}  // namespace longreach
