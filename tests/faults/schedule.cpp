#include "tests/faults/schedule.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "common/config/config.hpp"
#include "common/text/number_text.hpp"
#include "tests/faults/kind.hpp"

namespace longreach {
namespace {

constexpr int kKindsMax = 7;
constexpr int kTimesMax = 4;

std::size_t below(Random& random, std::size_t end) { return static_cast<std::size_t>(random.next() % end); }

Fault draw_fault(Random& random, const FaultKind& kind, double begin_s, double end_s) {
  Fault fault;
  fault.kind = kind.name;
  fault.duration_s = log_scale(random.uniform(), kind.shortest_s, kind.longest_s);
  fault.duration_s = std::min(fault.duration_s, 0.5 * (end_s - begin_s));
  fault.start_s = random.uniform(begin_s, end_s - fault.duration_s);
  fault.size = random.uniform();
  fault.seed = random.next();
  return fault;
}

[[noreturn]] void refuse(std::size_t line, const std::string& why) {
  throw ConfigError("schedule, line " + std::to_string(line) + ": " + why);
}

template <class Value>
void read(std::istringstream& words, std::size_t line, const std::string& name, Value& value) {
  std::string word;
  if (!(words >> word) || word != name || !(words >> value)) refuse(line, name + " is missing or no number");
}

}  // namespace

Schedule draw_schedule(std::uint64_t seed, double round_trip_s) {
  Random random = Random(seed).child("faults");
  Schedule schedule;
  schedule.seed = seed;
  const double begin_s = 2.0 + 2.0 * round_trip_s;
  schedule.faults_end_s = begin_s + log_scale(random.uniform(), 10.0, 30.0);
  schedule.end_s = schedule.faults_end_s + 7.0 + 6.0 * round_trip_s;
  std::vector<const FaultKind*> all;
  for (const FaultKind& kind : fault_kinds())
    if (kind.besides == 0.0) all.push_back(&kind);
  const std::size_t kinds = 1 + below(random, kKindsMax);
  for (std::size_t k = 0; k < kinds; ++k) {
    const FaultKind& kind = *all[below(random, all.size())];
    const std::size_t times = 1 + below(random, kTimesMax);
    for (std::size_t i = 0; i < times; ++i)
      schedule.faults.push_back(draw_fault(random, kind, begin_s, schedule.faults_end_s));
  }
  Random besides = Random(seed).child("faults besides");
  for (const FaultKind& kind : fault_kinds())
    if (besides.chance(kind.besides))
      schedule.faults.push_back(draw_fault(besides, kind, begin_s, schedule.faults_end_s));
  std::ranges::stable_sort(schedule.faults, {}, &Fault::start_s);
  return schedule;
}

std::string to_text(const Schedule& schedule) {
  std::string text = "seed " + std::to_string(schedule.seed) + "\nfaults_end_s " +
                     format_number(schedule.faults_end_s) + "\nend_s " + format_number(schedule.end_s) + "\n";
  for (const Fault& f : schedule.faults) {
    text += "fault " + f.kind + " start_s " + format_number(f.start_s) + " duration_s " +
            format_number(f.duration_s) + " size " + format_number(f.size) + " seed " +
            std::to_string(f.seed) + "\n";
  }
  return text;
}

Schedule parse_schedule(const std::string& text) {
  Schedule schedule;
  std::istringstream lines(text);
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    std::string word;
    if (!(words >> word) || word.starts_with('#')) continue;
    bool good = true;
    if (word == "seed") {
      good = static_cast<bool>(words >> schedule.seed);
    } else if (word == "faults_end_s") {
      good = static_cast<bool>(words >> schedule.faults_end_s);
    } else if (word == "end_s") {
      good = static_cast<bool>(words >> schedule.end_s);
    } else if (word == "fault") {
      Fault fault;
      good = static_cast<bool>(words >> fault.kind);
      static_cast<void>(fault_kind(fault.kind));
      read(words, number, "start_s", fault.start_s);
      read(words, number, "duration_s", fault.duration_s);
      read(words, number, "size", fault.size);
      read(words, number, "seed", fault.seed);
      schedule.faults.push_back(fault);
    } else {
      refuse(number, "'" + word + "' is neither seed, faults_end_s, end_s nor fault");
    }
    if (!good) refuse(number, word + " wants a value");
  }
  return schedule;
}

}  // namespace longreach
