#pragma once
// Remembers where the tool has moved freely during this engagement, and how far it may move ahead within that space.
// Space counts as free for 10 s within 5 to 10 mm around the measured positions of the tool without contact, which are
// stored in cells of 5 mm. At the front, the margin, up to 17 mm, is subtracted, so free_ahead_m() never extends beyond a
// position at which the tool has been. The cells are stored in a hash table with four entries per hash value. If a fifth
// one is added, the oldest is forgotten; its space is then unknown, which is the safe side. Pure; allocates only in the
// constructor.

#include <cstdint>
#include <optional>
#include <vector>

#include "common/spatial/spatial.hpp"

namespace longreach {

class FreeSpace {
 public:
  FreeSpace() : cells_(kBuckets * kEntries) {}

  /// Forgets everything, because an engagement starts.
  void forget() {
    now_s_ += 0.1;  // what was passed before is older than this
    began_ = tenth_of_second();
    at_ = {kNowhere, 0, 0};
    origin_m_.reset();
  }
  /// `dt` s have passed; the tool is at `p_WE` (m, finite). `free`: it touches nothing.
  void step(const Vector3& p_WE, bool free, double dt);
  /// Returns the distance from `p_WE` along `direction` (a unit vector) up to which space is free, at most `far_m`.
  [[nodiscard]] double free_ahead_m(const Vector3& p_WE, const Vector3& direction, double far_m) const;

 private:
  static constexpr std::size_t kBuckets = 1U << 13, kEntries = 4;
  static constexpr std::int32_t kNowhere = INT32_MIN;
  struct Place {
    std::int32_t x, y, z;
    bool operator==(const Place&) const = default;
  };
  struct Cell {
    Place place{kNowhere, 0, 0};
    std::uint32_t passed = 0;  // time, 0.1 s
  };
  [[nodiscard]] Place place_of(const Vector3& p) const;
  static std::size_t bucket_of(const Place& place);
  void mark(const Place& place);
  [[nodiscard]] bool passed(const Vector3& p) const;
  [[nodiscard]] std::uint32_t tenth_of_second() const { return static_cast<std::uint32_t>(10.0 * now_s_); }

  std::vector<Cell> cells_;
  std::optional<Vector3> origin_m_{};  // first position; the cells do not depend on the origin of W
  Place at_{kNowhere, 0, 0};
  double now_s_ = 20.0, marked_s_ = 0.0;  // longer than space is remembered
  std::uint32_t began_ = 200;
};

}  // namespace longreach
