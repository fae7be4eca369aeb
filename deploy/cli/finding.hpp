#pragma once
// Findings of the checks (doctor, adapter check), printed as one line per finding for users or as one JSON
// object for programs. Pure functions.

#include <cstdint>
#include <string>
#include <vector>

namespace longreach {

enum class FindingVerdict { kOk, kWarning, kFailure };

/// Histogram of measured durations.
struct Histogram {
  struct Bar {
    double up_to_s = 0.0;
    std::uint64_t count = 0;
  };
  std::vector<Bar> bars{};  // in ascending order; the last bar may be unbounded
};
/// Groups the times into bars with upper bounds 1, 2, 5, 10, ... or, if all times are within a factor of 2.5,
/// into bars of equal width. Returns no bars if there are no times.
Histogram histogram_of(const std::vector<double>& times_s);

struct Finding {
  FindingVerdict verdict = FindingVerdict::kOk;
  std::string what;      // subject of the check, one or two words
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
/// Returns, for example, "14 ok, 1 warning, 0 failures".
std::string diagnosis_summary(const Diagnosis& diagnosis);
std::string diagnosis_json(const Diagnosis& diagnosis);

}  // namespace longreach
