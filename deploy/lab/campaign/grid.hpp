#pragma once
// The cells of a campaign in order: experiments, then the values of each setting, then the seeds; the last
// varies fastest. The number of a cell is its index, from 0.

#include <cstdint>
#include <string>
#include <vector>

#include "proto/campaign.pb.h"

namespace longreach {

struct Cell {
  std::size_t number = 0;
  std::size_t combination = 0;     // index of the combination of settings
  std::string experiment;          // name
  std::vector<std::size_t> value;  // index of the value of each setting
  std::uint64_t seed = 1;
};

class Grid {
 public:
  /// A larger campaign is assumed to be a mistake: this one takes a day at a second per cell.
  static constexpr std::size_t kCellsMax = 100'000;

  /// A campaign with at least one experiment, a value for each setting, and seeds in order.
  explicit Grid(proto::Campaign campaign);

  /// Number of cells; kCellsMax + 1 for any number beyond kCellsMax.
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] std::size_t combinations() const;
  [[nodiscard]] Cell cell(std::size_t number) const;
  /// "PATH=VALUE" of each setting.
  [[nodiscard]] std::vector<std::string> settings(const Cell& cell) const;
  /// Name for the user: "touch profile=moon mapping.scale=0.2 seed=3".
  [[nodiscard]] std::string name(const Cell& cell) const;
  [[nodiscard]] const proto::Campaign& campaign() const { return campaign_; }

 private:
  [[nodiscard]] std::size_t seeds() const;

  proto::Campaign campaign_;
};

}  // namespace longreach
