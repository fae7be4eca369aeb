// Shows and changes the impairment of both directions.

#include <future>
#include <iostream>
#include <optional>
#include <utility>
#include <vector>

#include "common/config/config.hpp"
#include "common/config/file_search.hpp"
#include "common/config/link_profile.hpp"
#include "common/text/number_text.hpp"
#include "deploy/cli/commands.hpp"
#include "deploy/cli/json_text.hpp"
#include "deploy/cli/side_client.hpp"

namespace longreach {
namespace {

/// The change of one direction at the side where it is configured.
struct Change {
  Change(Side the_side, const Options& options, bool replaces, proto::Impairment the_fields)
      : side(the_side), replace(replaces), fields(std::move(the_fields)), client(side, options) {}

  Side side;
  bool replace;
  proto::Impairment fields;  // to set
  SideClient client;
  proto::Impairment before{};
};

std::vector<Change> changes_of(const Options& options, const LinkSetCommand& command) {
  proto::LinkProfile profile;
  if (command.profile) profile = load_link_profile(installed_files(), *command.profile);
  const bool replace = command.clear || command.profile;
  proto::Impairment up = command.profile ? impairment_of_slave(profile) : proto::Impairment();
  proto::Impairment down = profile.down();
  up.MergeFrom(command.fields);
  down.MergeFrom(command.fields);
  down.clear_rpc_delay_s();
  validate(up);
  validate(down);
  std::vector<Change> changes;
  // The slave comes first: a change that only the slave refuses then need not be restored at the master.
  if (command.direction != Direction::kDown)
    changes.emplace_back(Side::kSlave, options, replace, std::move(up));
  if (command.direction != Direction::kUp && (replace || down.ByteSizeLong() > 0))
    changes.emplace_back(Side::kMaster, options, replace, std::move(down));
  if (changes.empty()) throw UsageError("--rpc has an effect only at the slave: omit --direction down");
  return changes;
}

/// Fetches the present impairments. This also checks that every side responds and is the expected one.
void look(std::vector<Change>& changes) {
  for (Change& change : changes) change.before = change.client.link();
}

/// Restores the directions that were already changed, and describes the outcome.
std::string put_back(std::vector<Change>& changes, std::size_t changed) {
  std::string outcome;
  for (std::size_t i = 0; i < changed; ++i) {
    const std::string name(name_of(changes[i].side));
    try {
      changes[i].client.set_link(changes[i].before, true);
      outcome += "; the " + name + "'s impairment is restored";
    } catch (const SideError& error) {
      outcome += "; the " + name + "'s impairment stays changed: " + error.what();
    }
  }
  return outcome;
}

void apply(std::vector<Change>& changes) {
  for (std::size_t i = 0; i < changes.size(); ++i) {
    try {
      changes[i].client.set_link(changes[i].fields, changes[i].replace);
    } catch (const SideError& error) {
      std::string sentence = error.what();
      if (error.kind() == SideError::Kind::kDown) sentence += "; its impairment may have changed";
      throw SideError(error.kind(), sentence + put_back(changes, i));
    }
  }
}

struct Shown {
  std::optional<proto::Impairment> link{};
  std::string error;
};

Shown ask_link(Side side, const Options& options) {
  try {
    return {SideClient(side, options).link(), {}};
  } catch (const SideError& error) {
    return {{}, error.what()};
  }
}

}  // namespace

ExitStatus run_link_show(const Options& options) {
  auto slave = std::async(std::launch::async, ask_link, Side::kSlave, options);
  const Shown down = ask_link(Side::kMaster, options);
  const Shown up = slave.get();
  const std::string error = up.error + (up.error.empty() || down.error.empty() ? "" : "; ") + down.error;
  if (options.json) {
    std::cout << "{\"up\":" << (up.link ? json_object(*up.link) : "null")
              << ",\"down\":" << (down.link ? json_object(*down.link) : "null");
    if (!error.empty()) std::cout << ",\"error\":" << json_string(error);
    std::cout << "}\n";
  } else {
    if (up.link) std::cout << "up (master to slave, at the slave):     " << in_words(*up.link) << "\n";
    if (down.link) std::cout << "down (slave to master, at the master):  " << in_words(*down.link) << "\n";
  }
  std::cout.flush();
  if (error.empty()) return ExitStatus::kDone;
  std::cerr << "longreach: " << error << "\n";
  return ExitStatus::kFailed;
}

/// Describes the effect of the change on an engaged robot. Empty if there is none or if the master does not
/// respond.
std::string what_follows(const Options& options, std::vector<Change>& changes) try {
  double rise_s = 0.0;
  for (Change& change : changes) rise_s += change.client.link().delay_s() - change.before.delay_s();
  SideClient master(Side::kMaster, options);
  if (!(rise_s > 0.0) || master.status().state() != "Engaged") return "";
  const double most_s = parse_number(master.get("safety.delay_rise_max_s")).value_or(rise_s);
  if (rise_s <= most_s) return "";
  return "; the round trip rises by " + format_number(rise_s) +
         " s, more than safety.delay_rise_max_s = " + format_number(most_s) +
         ": the robot holds; accept the new delay with `longreach engage`";
} catch (const SideError&) {
  return "";
}

std::string set_link(const Options& options, const LinkSetCommand& command) {
  std::vector<Change> changes = changes_of(options, command);
  look(changes);
  apply(changes);
  std::string done;
  for (Change& change : changes)
    done += (done.empty() ? "" : "; ") + std::string(change.side == Side::kSlave ? "up: " : "down: ") +
            in_words(change.client.link());
  return done + what_follows(options, changes);
}

ExitStatus run_link_set(const Options& options, const LinkSetCommand& command) {
  print_done(options, set_link(options, command));
  return ExitStatus::kDone;
}

}  // namespace longreach
