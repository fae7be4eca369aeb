#pragma once
// The part of the command line that belongs to `longreach demo`.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "deploy/cli/invocation.hpp"

namespace longreach {

class DemoWords {
 public:
  /// Adds `demo` with its options.
  void declare(CLI::App& app);
  /// The parsed command, if `demo` was given.
  [[nodiscard]] DemoCommand command() const;

 private:
  CLI::App* demo_ = nullptr;
  std::string profile_, operator_, robot_, seconds_, task_, logs_;
  std::vector<std::string> settings_;
};

}  // namespace longreach
