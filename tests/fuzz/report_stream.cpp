// Any stream of stiffness reports into a hand that moves in any way: the wrench is finite and within its
// limits, and no report makes the force step. Input: (ticks before it, move of the hand in x y z, length,
// body) after each other.

#include "common/wire/codec.hpp"
#include "master/rendering/renderer.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace longreach::fuzz {
namespace {

constexpr std::size_t kRecordBytes = 5;
constexpr double kMovePerTick_m = 2e-3;  // 2 m/s

class Hand {
 public:
  explicit Hand(GoalHistories& history) : history_(history) {
    history_.clear();
    at_.live = true;
    at_.handle.held = true;
    mapping_.reset(at_.handle);
    renderer_.reset(at_.handle);
  }

  void tick(const Vector3& move_m) {
    at_.handle.velocity_m_per_s = move_m / kPeriod_s;
    at_.handle.p_MH += move_m;
    // No device is larger.
    at_.handle.p_MH = at_.handle.p_MH.cwiseMin(0.2).cwiseMax(-0.2);
    mapping_.step({at_.handle, at_.mode, at_.scale, false}, kPeriod_s);
    const Wrench F = renderer_.step(at_, mapping_);
    require(std::isfinite(renderer_.force_step_n()), "the step by a report is finite");
    require(F.force.allFinite() && F.moment.allFinite(), "a wrench is finite");
    require(F.force.norm() <= config_.force_max_n + 1e-9 && F.moment.norm() <= config_.moment_max_nm + 1e-9,
            "a wrench is within its limits");
    require(renderer_.stiffness(renderer_.translation()) <= config_.stiffness_max_n_per_m * (1.0 + 1e-9),
            "the stiffness is what the device can render");
    ++sequence_;
    history_.translation.push(sequence_, mapping_.goal().position_m);
    history_.rotation.push(sequence_, mapping_.goal().rotation_rad);
  }

  void take(const StiffnessReport& report) { (void)renderer_.on_report(report, history_, at_, mapping_); }

 private:
  static constexpr double kPeriod_s = 1e-3;
  RenderingConfig config_{};
  Mapping mapping_{MappingConfig{}};
  Renderer renderer_{config_, RenderedDevice{}};
  GoalHistories& history_;
  RendererInput at_{};
  std::uint64_t sequence_ = 0;
};

Vector3 move_of(std::span<const std::byte> record) {
  Vector3 move;
  for (int i = 0; i < 3; ++i)
    move[i] = static_cast<double>(static_cast<std::int8_t>(record[static_cast<std::size_t>(1 + i)])) / 128.0;
  return kMovePerTick_m * move;
}

}  // namespace
}  // namespace longreach::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace longreach;
  static Codec codec;
  static GoalHistories history(1024);
  fuzz::Hand hand(history);
  auto rest = std::as_bytes(std::span(bytes, size));
  for (int i = 0; rest.size() >= fuzz::kRecordBytes && i < 8; ++i) {
    const int ticks = 1 + std::to_integer<int>(rest[0]) % 4;
    const Vector3 move = fuzz::move_of(rest);
    const auto length = std::min(std::to_integer<std::size_t>(rest[4]), rest.size() - fuzz::kRecordBytes);
    for (int k = 0; k < ticks; ++k) hand.tick(move);
    Stamp stamp;
    StiffnessReport report;
    if (!codec.decode(rest.subspan(fuzz::kRecordBytes, length), stamp, report)) hand.take(report);
    rest = rest.subspan(fuzz::kRecordBytes + length);
  }
  return 0;
}
