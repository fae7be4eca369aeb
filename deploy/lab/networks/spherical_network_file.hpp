#pragma once
// Reads and writes the file with the weights of the networks of a 3-RRR device (proto/network.proto). Only
// the format is checked here; SphericalNetwork checks whether the networks fit a geometry.

#include <filesystem>
#include <string>

#include "deploy/lab/networks/spherical_network_config.hpp"

namespace longreach {

struct SphericalNetworkFile {
  std::string name;  // name of the mechanism in the catalog
  SphericalNetworkConfig config;
  double error_max_rad = 0.0;  // measured after training
  double error_rms_rad = 0.0;
};

/// Throws a ConfigError that names the file if it cannot be parsed ("FILE:LINE:COLUMN: ...", as in
/// load_text_file), if a field is missing, or if the number of subspaces differs from that of the grid.
SphericalNetworkFile load_spherical_network(const std::filesystem::path& file);

/// Returns the text of a file that begins with `comment` (lines that start with "#") and has one line per
/// hidden unit. Parsing the text restores every number bit by bit.
std::string spherical_network_text(const SphericalNetworkFile& network, const std::string& comment);

}  // namespace longreach
