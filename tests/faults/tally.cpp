#include "tests/faults/tally.hpp"

#include <sstream>

#include "common/config/config.hpp"
#include "common/text/number_text.hpp"
#include "tests/faults/guard_watch.hpp"
#include "tests/faults/kind.hpp"

namespace longreach {
namespace {

using Counts = std::map<std::string, std::uint64_t>;

void add_counts(Counts& to, const Counts& from) {
  for (const auto& [name, times] : from) to[name] += times;
}

std::string lines(const char* what, const Counts& counts) {
  std::string text;
  for (const auto& [name, times] : counts)
    text += std::string(what) + " " + std::to_string(times) + " " + name + "\n";
  return text;
}

std::uint64_t mixed(std::uint64_t a, std::uint64_t b) { return (a ^ (b >> 32)) * 0x100000001b3ULL ^ b; }

}  // namespace

void Tally::add(std::uint64_t seed, const Trial& trial) {
  ++seeds;
  virtual_s += trial.virtual_s;
  engaged_s += trial.engaged_s;
  for (std::size_t i = 0; i < trial.injected.size(); ++i)
    kinds[std::string(fault_kinds()[i].name)] += trial.injected[i];
  add_counts(guards, trial.guards);
  for (const Judged& j : trial.judged) {
    judged[std::string(j.name)] += j.times;
    violated[std::string(j.name)] += j.violated;
  }
  for (const Breach& v : trial.violations) failures.push_back({seed, v});
  trajectories = mixed(trajectories, trial.trajectory);
}

void Tally::add(const Tally& other) {
  seeds += other.seeds;
  virtual_s += other.virtual_s;
  engaged_s += other.engaged_s;
  add_counts(kinds, other.kinds);
  add_counts(guards, other.guards);
  add_counts(judged, other.judged);
  add_counts(violated, other.violated);
  failures.insert(failures.end(), other.failures.begin(), other.failures.end());
  trajectories = mixed(trajectories, other.trajectories);
}

void Tally::judge(std::uint64_t seed, const char* invariant, bool good, const char* words) {
  ++judged[invariant];
  violated[invariant] += good ? 0 : 1;
  if (!good) failures.push_back({seed, {invariant, 0.0, words}});
}

std::string to_text(const Tally& t) {
  std::string text = "seeds " + std::to_string(t.seeds) + "\nvirtual_s " + format_number(t.virtual_s) +
                     "\nengaged_s " + format_number(t.engaged_s) + "\ntrajectories " +
                     std::to_string(t.trajectories) + "\n";
  text += lines("kind", t.kinds) + lines("guard", t.guards) + lines("judged", t.judged) +
          lines("violated", t.violated);
  for (const Failure& f : t.failures) {
    text += "failure " + std::to_string(f.seed) + " " + f.violation.invariant + " " +
            format_number(f.violation.t_s) + " " + f.violation.words + "\n";
  }
  return text + "end\n";
}

Tally parse_tally(const std::string& text) {
  Tally tally;
  const std::map<std::string, Counts*> counts = {{"kind", &tally.kinds},
                                                 {"guard", &tally.guards},
                                                 {"judged", &tally.judged},
                                                 {"violated", &tally.violated}};
  std::istringstream stream(text);
  std::string line, word;
  while (std::getline(stream, line)) {
    std::istringstream words(line);
    words >> word;
    if (word == "end") return tally;
    if (const auto at = counts.find(word); at != counts.end()) {
      std::uint64_t times = 0;
      words >> times >> std::ws;
      std::getline(words, word);
      (*at->second)[word] = times;
    } else if (word == "failure") {
      Failure& f = tally.failures.emplace_back();
      words >> f.seed >> f.violation.invariant >> f.violation.t_s >> std::ws;
      std::getline(words, f.violation.words);
    } else if (word == "seeds") {
      words >> tally.seeds;
    } else if (word == "virtual_s") {
      words >> tally.virtual_s;
    } else if (word == "engaged_s") {
      words >> tally.engaged_s;
    } else if (word == "trajectories") {
      words >> tally.trajectories;
    }
    if (!words && !words.eof()) break;
  }
  throw ConfigError("a tally of faults is cut or damaged at '" + line + "'");
}

std::vector<std::string> never_seen(const Tally& tally) {
  std::vector<std::string> missing;
  const auto never = [](const Counts& counts, const std::string& name) {
    const auto at = counts.find(name);
    return at == counts.end() || at->second == 0;
  };
  for (const FaultKind& kind : fault_kinds())
    if (never(tally.kinds, std::string(kind.name))) missing.push_back("kind " + std::string(kind.name));
  for (const std::string& guard : guard_names())
    if (never(tally.guards, guard)) missing.push_back("guard " + guard);
  for (const auto& [name, times] : tally.judged)
    if (times == 0) missing.push_back("invariant " + name);
  return missing;
}

}  // namespace longreach
