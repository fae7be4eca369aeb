#pragma once
// What the doctor finds, and how it is told: a line a finding for people, one JSON object for programs. Pure.

#include <cstdint>
#include <string>
#include <vector>

namespace longreach {

enum class FindingVerdict { kOk, kWarning, kFailure };

/// How often a time was met.
struct Histogram {
  struct Bar {
    double up_to_s = 0.0;
    std::uint64_t count = 0;
  };
  std::vector<Bar> bars{};  // rising; the last one may be open
};
/// Into bars up to 1, 2, 5, 10, ... that cover what was seen, or, where all is within a factor of 2.5, into
/// bars of one width. Nothing seen: no bars.
Histogram histogram_of(const std::vector<double>& times_s);

struct Finding {
  FindingVerdict verdict = FindingVerdict::kOk;
  std::string what;      // what was looked at, a word or two
  std::string text;      // what was found
  std::string advice{};  // what to do; empty: nothing
  Histogram histogram{};
};

struct Section {
  std::string title;
  std::vector<Finding> findings{};
};

using Diagnosis = std::vector<Section>;

std::uint64_t count(const Diagnosis& diagnosis, FindingVerdict verdict);
std::string diagnosis_text(const Section& section);
/// "14 ok, 1 warning, 0 failures"
std::string diagnosis_summary(const Diagnosis& diagnosis);
std::string diagnosis_json(const Diagnosis& diagnosis);

}  // namespace longreach
