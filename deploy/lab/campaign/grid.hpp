#pragma once
// The cells of a campaign: every combination of experiment, setting values and seed. The seed varies fastest,
// the experiment slowest. Cells are numbered from 0.

#include <cstdint>
#include <string>
#include <vector>

#include "proto/campaign.pb.h"

namespace longreach {

struct Cell {
  std::size_t number = 0;
  std::size_t combination = 0;     // index of the combination of setting values
  std::string experiment;          // name
  std::vector<std::size_t> value;  // index of the value of each setting
  std::uint64_t seed = 1;
};

class Grid {
 public:
  /// A larger campaign is assumed to be a mistake: at one second per cell, kCellsMax cells take more than a
  /// day.
  static constexpr std::size_t kCellsMax = 100'000;

  /// The campaign must have at least one experiment and one value per setting; seeds.from must be <=
  /// seeds.to.
  explicit Grid(proto::Campaign campaign);

  /// Number of cells, capped at kCellsMax + 1.
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] std::size_t combinations() const;
  [[nodiscard]] Cell cell(std::size_t number) const;
  /// Returns "PATH=VALUE" for each setting of the cell.
  [[nodiscard]] std::vector<std::string> settings(const Cell& cell) const;
  /// Name shown to the user, for example "touch profile=moon mapping.scale=0.2 seed=3".
  [[nodiscard]] std::string name(const Cell& cell) const;
  [[nodiscard]] const proto::Campaign& campaign() const { return campaign_; }

 private:
  [[nodiscard]] std::size_t seeds() const;

  proto::Campaign campaign_;
};

}  // namespace longreach
