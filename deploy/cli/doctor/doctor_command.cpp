// longreach doctor: checks this host, its site and both sides, and prints remedies.

#include <unistd.h>

#include <future>
#include <iostream>

#include "deploy/cli/commands.hpp"
#include "deploy/cli/doctor/doctor_checks.hpp"
#include "deploy/cli/json_text.hpp"

namespace longreach {
namespace {

/// Shows on a terminal what is being checked until the next section is complete.
class Progress {
 public:
  explicit Progress(const std::string& what) : shown_(isatty(STDERR_FILENO) == 1) {
    if (shown_) std::cerr << what << " ..." << std::flush;
  }
  ~Progress() {
    if (shown_) std::cerr << "\r\x1b[K" << std::flush;
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

 private:
  bool shown_;
};

}  // namespace

ExitStatus run_doctor(const Options& options, const DoctorCommand& command) {
  Diagnosis all;
  const auto add = [&](Section section) {
    if (!options.json) std::cout << diagnosis_text(section) << std::endl;
    all.push_back(std::move(section));
  };
  add(examine_site(options));
  {
    std::optional<Progress> progress(std::in_place, "querying both sides");
    auto master = std::async(std::launch::async, examine_side, Side::kMaster, options, command.seconds);
    Section slave = examine_side(Side::kSlave, options, command.seconds);
    Section section = master.get();
    progress.reset();
    add(std::move(slave));
    add(std::move(section));
  }
  {
    std::optional<Progress> progress(std::in_place, "measuring the timing of this machine");
    Section machine = examine_machine(command.seconds);
    progress.reset();
    add(std::move(machine));
  }
  std::cout << (options.json ? diagnosis_json(all) : diagnosis_summary(all)) << std::endl;
  return count(all, FindingVerdict::kFailure) == 0 ? ExitStatus::kDone : ExitStatus::kFailed;
}

}  // namespace longreach
