#include "deploy/cli/adapter/handle_findings.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "common/config/config.hpp"
#include "common/config/file_search.hpp"
#include "deploy/cli/adapter/adapter_subject.hpp"
#include "deploy/cli/invocation.hpp"
#include "master/devices/handle_plausibility.hpp"

namespace longreach {
namespace {

constexpr double kMillimetres = 1000.0;  // in a metre
constexpr double kSeen = 0.01;           // share of the workspace that a handle in the hand passes, at least
constexpr double kMoved_m = 2e-5;        // more than the noise of encoders

HandleState state_of(const adapter::HandleDatagram& d, bool turns) {
  HandleState s;
  s.p_MH = {d.position_m[0], d.position_m[1], d.position_m[2]};
  if (turns)
    s.q_MH = Quaternion(d.orientation[0], d.orientation[1], d.orientation[2], d.orientation[3]).normalized();
  return s;
}

Finding jumps(const std::vector<SeenHandle>& seen, DeviceConfig device, bool described) {
  constexpr double kAnywhere = 1e9;
  if (!described) device.delta.workspace_m = device.spherical.workspace_rad = kAnywhere;
  HandlePlausibility watch(device);
  int count = 0;
  Reason largest;
  for (const SeenHandle& one : seen) {
    const Reason found = watch.check(state_of(one.handle, device.turns), Time(Duration(one.at_ns)));
    if (found != HoldCause::kHandleJumped) continue;
    ++count;
    if (largest == HoldCause::kNone || found.value > largest.value) largest = found;
  }
  if (count == 0) return {FindingVerdict::kOk, "motion", "the handle did not jump"};
  return {
      FindingVerdict::kFailure, "motion", std::to_string(count) + " times: " + sentence(largest),
      "report the position in metres and the orientation as a unit quaternion w x y z, without gaps; check "
      "the encoders"};
}

Finding workspace(const std::vector<SeenHandle>& seen, const DeviceConfig& device) {
  const double reach_m = device.delta.workspace_m, reach_rad = device.spherical.workspace_rad;
  double far_m = 0.0, far_rad = 0.0;
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const SeenHandle& one : seen) {
    const HandleState s = state_of(one.handle, device.turns);
    far_m = std::max(far_m, s.p_MH.norm());
    far_rad = std::max(far_rad, log_rotation(s.q_MH).norm());
    low = low.cwiseMin(s.p_MH);
    high = high.cwiseMax(s.p_MH);
  }
  const double moved_m = seen.empty() ? 0.0 : (high - low).norm();
  const std::string text = in_text("up to %.4g m from home", far_m) + in_text(" (workspace %g m)", reach_m) +
                           in_text(", moved over %.4g m", moved_m);
  if (far_m > HandlePlausibility::kOutside * reach_m) {
    const bool in_mm = far_m / kMillimetres <= reach_m;
    return {FindingVerdict::kFailure, "workspace", "the handle is " + text,
            in_mm ? "report metres: the values seem to be in millimetres"
                  : "report metres from the home position, and use the device file of this device"};
  }
  if (far_rad > HandlePlausibility::kOutside * reach_rad)
    return {FindingVerdict::kFailure, "workspace",
            in_text("the handle is turned by %.3g rad", far_rad) + in_text(" (range %g rad)", reach_rad),
            "report the orientation relative to home as a unit quaternion in the order w x y z, and use the "
            "device file of this device"};
  if (moved_m > kMoved_m && moved_m < kSeen * reach_m)
    return {FindingVerdict::kWarning, "workspace", text,
            "if you moved the handle through its workspace during the check, report metres: the values seem "
            "to be in kilometres, or scaled otherwise"};
  return {FindingVerdict::kOk, "workspace", text};
}

}  // namespace

std::vector<Finding> handle_findings(const std::vector<SeenHandle>& seen,
                                     const std::optional<DeviceConfig>& device) {
  std::vector<Finding> all{jumps(seen, device.value_or(DeviceConfig{}), device.has_value())};
  if (device) all.push_back(workspace(seen, *device));
  return all;
}

DeviceConfig described_device(const std::string& file) try {
  proto::MasterConfig config;
  const FileSearch search = installed_files();
  set_field(config, "device_file",
            placed_setting("device_file=" + file, search).substr(std::strlen("device_file=")));
  resolve_files(config, search, nullptr);
  return to_struct(config).device;
} catch (const ConfigError& error) {
  throw UsageError(error.what());
}

}  // namespace longreach
