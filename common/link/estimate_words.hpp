#pragma once
// Text for the operator about the estimates of a contact and of a load: values, accuracy, and the parameters
// that are not identifiable. Pure.

#include <string>
#include <string_view>

#include "schema/state_link.hpp"

namespace longreach {

/// Returns, for example, "1.02e+03 N/m within 0.5 %" (one standard deviation), or an empty string if there is
/// no estimate. `unit` is the unit of the stiffness.
std::string stiffness_in_words(const ContactEstimate& estimate, std::string_view unit);

/// Returns, for example, "n 1.5 within 0.02, lambda not identifiable apart from k", or an empty string if
/// there is no estimate.
std::string law_in_words(const ContactEstimate& estimate);

/// Returns the state of the gripper: open, closed, or holding a load, with its mass in kg if that is known.
std::string in_words(const GripperState& gripper);

}  // namespace longreach
