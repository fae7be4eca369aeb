#include "deploy/lab/networks/train.hpp"

#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "deploy/lab/networks/train_spherical.hpp"

namespace longreach {

std::vector<std::string> train_kinds() { return {"spherical"}; }

void train(const std::string& kind, std::uint64_t seed, const std::filesystem::path& out) {
  if (kind != "spherical") throw std::runtime_error("unknown network " + kind);
  // Checks before the training, which takes minutes, that the file can be written. If the training is
  // interrupted, the old file remains.
  std::error_code none;
  const bool existed = std::filesystem::exists(out, none);
  std::ofstream file(out, std::ios::binary | std::ios::app);
  if (!file) throw std::runtime_error("cannot write " + out.string());
  file.close();
  if (!existed) std::filesystem::remove(out, none);
  SphericalTraining training;
  training.seed = seed;
  const SphericalNetworkFile network = train_spherical(
      training, [](const std::string& line) { std::fprintf(stderr, "train spherical: %s\n", line.c_str()); });
  file.open(out, std::ios::binary | std::ios::trunc);
  file << trained_text(training, network);
  if (!file.flush()) throw std::runtime_error("cannot write " + out.string());
  std::printf("written to %s\n", out.c_str());
}

}  // namespace longreach
