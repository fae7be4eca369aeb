// longreach adapter check: checks a user's adapter for a device or a robot.

#include <iostream>

#include "common/net/address.hpp"
#include "deploy/cli/adapter/adapter_checks.hpp"
#include "deploy/cli/adapter/adapter_push.hpp"
#include "deploy/cli/commands.hpp"

namespace longreach {

ExitStatus run_adapter_check(const Options& options, const AdapterCheckCommand& command) {
  try {
    const Section section =
        command.push    ? check_pushes(command.address, command.robot_file, command.push_timeout_s)
        : command.robot ? check_robot_adapter(command.address, command.move)
                        : check_device_adapter(command.address, command.force_n, command.device_file);
    const Diagnosis diagnosis{section};
    if (options.json) {
      std::cout << diagnosis_json(diagnosis) << std::endl;
    } else {
      std::cout << diagnosis_text(section) << "\n" << diagnosis_summary(diagnosis) << std::endl;
    }
    return count(diagnosis, FindingVerdict::kFailure) == 0 ? ExitStatus::kDone : ExitStatus::kFailed;
  } catch (const AddressError& error) {
    throw UsageError(error.what());
  }
}

}  // namespace longreach
