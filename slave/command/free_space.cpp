#include "slave/command/free_space.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace longreach {
namespace {

constexpr double kCell_m = 5e-3;
// Largest distance of a marked point from the position that marked it: the diagonal of two cells.
constexpr double kFront_m = 2.0 * std::numbers::sqrt3 * kCell_m;
constexpr std::uint32_t kRemembered = 100;  // 0.1 s
constexpr double kAgain_s = 0.5;            // a tool that stays in a cell marks it again
constexpr double kReach_cells = 1e9;        // positions beyond this have no cell
constexpr int kRefinements = 3;             // of the front, halvings of a cell

}  // namespace

FreeSpace::Place FreeSpace::place_of(const Vector3& p) const {
  const Vector3 place = p - origin_m_.value_or(Vector3::Zero());
  const auto cell = [](double x) {
    return static_cast<std::int32_t>(std::clamp(std::floor(x / kCell_m + 0.5), -kReach_cells, kReach_cells));
  };
  return {cell(place.x()), cell(place.y()), cell(place.z())};
}

// Spatial hash of Teschner et al. 2003.
std::size_t FreeSpace::bucket_of(const Place& place) {
  const auto mix = [](std::int32_t i, std::uint32_t prime) { return static_cast<std::uint32_t>(i) * prime; };
  return (mix(place.x, 73856093U) ^ mix(place.y, 19349663U) ^ mix(place.z, 83492791U)) % kBuckets * kEntries;
}

// Replaces the cell itself or the oldest one of its bucket.
void FreeSpace::mark(const Place& place) {
  const auto begin = cells_.begin() + static_cast<std::ptrdiff_t>(bucket_of(place));
  const auto end = begin + kEntries;
  auto entry = std::find_if(begin, end, [&](const Cell& cell) { return cell.place == place; });
  if (entry == end)
    entry = std::min_element(begin, end, [](const Cell& a, const Cell& b) { return a.passed < b.passed; });
  *entry = {place, tenth_of_second()};
}

void FreeSpace::step(const Vector3& p_WE, bool free, double dt) {
  now_s_ += dt;
  if (!origin_m_) origin_m_ = p_WE;
  const Place here = place_of(p_WE);
  if (!free || (here == at_ && now_s_ - marked_s_ < kAgain_s)) return;
  at_ = here;
  marked_s_ = now_s_;
  for (std::int32_t x = -1; x <= 1; ++x) {
    for (std::int32_t y = -1; y <= 1; ++y) {
      for (std::int32_t z = -1; z <= 1; ++z) {
        mark({here.x + x, here.y + y, here.z + z});
      }
    }
  }
}

bool FreeSpace::passed(const Vector3& p) const {
  const Place place = place_of(p);
  const std::uint32_t oldest = std::max(began_, tenth_of_second() - kRemembered);
  const auto begin = cells_.begin() + static_cast<std::ptrdiff_t>(bucket_of(place));
  return std::any_of(begin, begin + kEntries,
                     [&](const Cell& cell) { return cell.place == place && cell.passed >= oldest; });
}

double FreeSpace::free_ahead_m(const Vector3& p_WE, const Vector3& direction, double far_m) const {
  double front_m = 0.0;
  while (front_m < far_m + kFront_m && passed(p_WE + front_m * direction)) front_m += kCell_m;
  if (front_m >= far_m + kFront_m) return far_m;
  double step_m = 0.5 * kCell_m;
  double known_m = front_m - kCell_m;
  for (int i = 0; i < kRefinements; ++i, step_m *= 0.5)
    if (passed(p_WE + (known_m + step_m) * direction)) known_m += step_m;
  return std::clamp(known_m - kFront_m, 0.0, far_m);
}

}  // namespace longreach
