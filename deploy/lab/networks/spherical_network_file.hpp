#pragma once
// The weights file of a 3-RRR device's networks (proto/network.proto), and the text that is written as one.
// Only form is judged here; whether the networks fit a geometry is judged by SphericalNetwork.

#include <filesystem>
#include <string>

#include "deploy/lab/networks/spherical_network_config.hpp"

namespace longreach {

struct SphericalNetworkFile {
  std::string name;  // of the mechanism in the catalog
  SphericalNetworkConfig config;
  double error_max_rad = 0.0;  // measured when it was trained
  double error_rms_rad = 0.0;
};

/// Throws ConfigError "FILE:LINE:COLUMN: ..." as load_text_file does, "FILE: FIELD is missing", and for a
/// number of subspaces that is not the grid's.
SphericalNetworkFile load_spherical_network(const std::filesystem::path& file);

/// A file with `comment` above ("# ..." lines); one line a unit; every number parses back to the same bits.
std::string spherical_network_text(const SphericalNetworkFile& network, const std::string& comment);

}  // namespace longreach
