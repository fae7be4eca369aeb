#pragma once
// The weights file of the networks of a 3-RRR device (proto/network.proto), and its text. It checks only the
// form; SphericalNetwork checks whether the networks fit a geometry.

#include <filesystem>
#include <string>

#include "deploy/lab/networks/spherical_network_config.hpp"

namespace longreach {

struct SphericalNetworkFile {
  std::string name;  // of the mechanism in the catalog
  SphericalNetworkConfig config;
  double error_max_rad = 0.0;  // measured after training
  double error_rms_rad = 0.0;
};

/// Throws ConfigError "FILE:LINE:COLUMN: ..." like load_text_file, "FILE: FIELD is missing", and for a number
/// of subspaces that differs from that of the grid.
SphericalNetworkFile load_spherical_network(const std::filesystem::path& file);

/// A file that begins with `comment` ("# ..." lines); one line per unit; every number parses back to the same
/// bits.
std::string spherical_network_text(const SphericalNetworkFile& network, const std::string& comment);

}  // namespace longreach
