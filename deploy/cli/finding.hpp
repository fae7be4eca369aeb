#pragma once
// Findings of the doctor and their output: a line per finding for users, one JSON object for programs. Pure.

#include <cstdint>
#include <string>
#include <vector>

namespace longreach {

enum class FindingVerdict { kOk, kWarning, kFailure };

/// Number of occurrences of a time.
struct Histogram {
  struct Bar {
    double up_to_s = 0.0;
    std::uint64_t count = 0;
  };
  std::vector<Bar> bars{};  // ascending; the last one may be unbounded
};
/// Groups the times into bars up to 1, 2, 5, 10, ..., or, if all are within a factor of 2.5, into bars of
/// equal width. Without times: no bars.
Histogram histogram_of(const std::vector<double>& times_s);

struct Finding {
  FindingVerdict verdict = FindingVerdict::kOk;
  std::string what;      // subject of the check, a word or two
  std::string text;      // result
  std::string advice{};  // remedy; empty: none
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
