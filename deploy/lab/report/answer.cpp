#include "deploy/lab/report/answer.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace longreach {
namespace {

[[noreturn]] void refuse(std::string_view place, const char* why) {
  throw std::invalid_argument("{" + std::string(place) + "} " + why);
}

double value_of(std::string_view place, const std::vector<Metric>& metrics) {
  const std::string_view name = place.substr(0, place.find('*'));
  const auto metric = std::ranges::find(metrics, name, &Metric::name);
  if (metric == metrics.end()) refuse(place, "is not a metric");
  if (metric->of_machine) refuse(place, "differs between machines");
  if (name.size() == place.size()) return metric->value;
  const std::string_view text = place.substr(name.size() + 1);
  double factor = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), factor);
  if (error != std::errc{} || end != text.data() + text.size()) refuse(place, "has no number after the *");
  return factor * metric->value;
}

}  // namespace

std::string figure(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.2e", value);
  const double rounded = std::strtod(text, nullptr);
  const double size = std::abs(rounded);
  if (rounded == 0.0) return "0";
  if (size >= 100.0 && size < 1e6) {
    std::snprintf(text, sizeof text, "%.0f", value);
  } else if (size >= 1e-3 && size < 100.0) {
    std::snprintf(text, sizeof text, "%.3g", rounded);
  } else {
    std::snprintf(text, sizeof text, "%.2g", value);
  }
  return text;
}

std::string answer(std::string_view sentence, const std::vector<Metric>& metrics) {
  std::string text;
  while (!sentence.empty()) {
    const std::size_t open = sentence.find('{');
    text += sentence.substr(0, open);
    if (open == std::string_view::npos) break;
    const std::size_t close = sentence.find('}', open);
    if (close == std::string_view::npos) refuse(sentence.substr(open + 1), "is not closed");
    text += figure(value_of(sentence.substr(open + 1, close - open - 1), metrics));
    sentence.remove_prefix(close + 1);
  }
  return text;
}

}  // namespace longreach
