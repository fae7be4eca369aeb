#include "master/desk/desk.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <thread>

#include "common/loop/pace.hpp"
#include "common/loop/real_time_loop.hpp"
#include "common/rpc/caller_certificate.hpp"
#include "common/rpc/rpc_server.hpp"
#include "master/desk/desk_frame.hpp"

namespace longreach {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kSilentHandsMax = kHandsMax / 2;  // they receive an error message if they resume
/// Maximum delay until a disconnected follower is detected.
constexpr auto kLeaveCheck = std::chrono::milliseconds(100);

/// Returns false if the server stops or the client has disconnected.
bool wait_until(Clock::time_point due, const grpc::ServerContext& context) {
  while (!context.IsCancelled()) {
    const auto now = Clock::now();
    if (now >= due) return true;
    std::this_thread::sleep_until(std::min(due, now + kLeaveCheck));
  }
  return false;
}

double follow_hz(const proto::FollowRequest& request) {
  if (!request.has_rate_hz()) return kWatchHzMax;
  if (!(request.rate_hz() > kWatchHzMin)) return kWatchHzMin;  // applies to NaN as well
  return std::min(request.rate_hz(), kWatchHzMax);
}

/// Converts three numbers; an empty field is zero. Returns none if the field is invalid.
template <class Field>
std::optional<Vector3> vector(const Field& numbers, double radius) {
  if (numbers.empty()) return Vector3::Zero();
  if (numbers.size() != 3) return std::nullopt;
  const Vector3 v(numbers[0], numbers[1], numbers[2]);
  // Beyond this limit a square could overflow.
  if (!v.allFinite() || v.cwiseAbs().maxCoeff() > 1e6) return std::nullopt;
  return Vector3(clamp_norm(v, radius));
}

std::optional<RemoteAim> to_aim(const proto::HandAim& message, const DeskService::Reach& reach) {
  const auto position_m = vector(message.position_m(), reach.translation_m);
  const auto rotation_rad = vector(message.rotation_rad(), reach.rotation_rad);
  if (!position_m || !rotation_rad) return std::nullopt;
  return RemoteAim{.position_m = *position_m,
                   .rotation_rad = *rotation_rad,
                   .clutch = message.clutch(),
                   .grip = message.grip(),
                   .holds = true,
                   .said = boottime_now()};
}

}  // namespace

DeskService::DeskService(const Reach& reach, std::function<ConsoleSnapshot()> snapshot,
                         std::function<void(const RemoteAim&)> aim)
    : reach_(reach), snapshot_(std::move(snapshot)), aim_(std::move(aim)) {}

grpc::Status DeskService::Follow(grpc::ServerContext* context, const proto::FollowRequest* request,
                                 grpc::ServerWriter<proto::Frame>* writer) {
  if (!take(followers_, kFollowersMax)) {
    return {grpc::StatusCode::RESOURCE_EXHAUSTED,
            std::to_string(kFollowersMax) + " clients are already following the master: close one of them"};
  }
  // Frames are not buffered, because a frame that waits in a buffer is out of date.
  const auto options = grpc::WriteOptions().set_no_compression().set_write_through();
  for (Pace pace(follow_hz(*request)); wait_until(pace.due(), *context); pace.advance()) {
    if (is_revoked(*context->auth_context())) break;
    if (!writer->Write(to_frame(snapshot_(), reach_.translation_m), options)) break;
  }
  leave(followers_);
  return grpc::Status::OK;
}

grpc::Status DeskService::Hold(grpc::ServerContext* context, grpc::ServerReader<proto::HandAim>* reader,
                               proto::Outcome* answer) {
  if (!aim_)
    return {grpc::StatusCode::FAILED_PRECONDITION,
            "the handle is a real device, so no client can take control of it"};
  if (!take(hands_there_, kHandsMax)) {
    return {grpc::StatusCode::RESOURCE_EXHAUSTED,
            std::to_string(kHandsMax) +
                " clients are already connected to control the handle: close one of them"};
  }
  const grpc::Status status = follow_hand(*context, *reader, *answer);
  leave_handle(*context);
  leave(hands_there_);
  return status;
}

grpc::Status DeskService::follow_hand(grpc::ServerContext& context,
                                      grpc::ServerReader<proto::HandAim>& reader, proto::Outcome& answer) {
  const std::uint64_t hand = take_handle(context);
  if (hand == 0) {
    return {grpc::StatusCode::FAILED_PRECONDITION,
            "another client has the handle; it must release the handle first, or send nothing for 0.3 s"};
  }
  for (proto::HandAim message; reader.Read(&message);) {
    if (is_revoked(*context.auth_context()))
      return {grpc::StatusCode::PERMISSION_DENIED, "the certificate of this host was revoked"};
    if (message.lets_go()) {
      (void)pass(hand, {});
      answer.set_message("the hand released the handle");
      return grpc::Status::OK;
    }
    const auto aim = to_aim(message, reach_);
    if (!aim) {
      return {grpc::StatusCode::INVALID_ARGUMENT,
              "position_m and rotation_rad must each contain three finite numbers with magnitudes up "
              "to 1e6"};
    }
    if (!pass(hand, *aim)) return {grpc::StatusCode::ABORTED, "another client took the handle"};
  }
  // The last aim becomes too old, which causes a hold. A broken stream may look like one that was closed, so
  // both are treated in the same way.
  return {grpc::StatusCode::CANCELLED,
          "the connection ended before the client released the handle: the robot holds"};
}

bool DeskService::take(int& taken, int places) {
  const std::lock_guard lock(mutex_);
  if (taken >= places) return false;
  ++taken;
  return true;
}

void DeskService::leave(int& taken) {
  const std::lock_guard lock(mutex_);
  --taken;
}

void DeskService::leave_handle(const grpc::ServerContext& context) {
  const std::lock_guard lock(mutex_);
  if (holder_ == &context) holder_ = nullptr;
}

std::uint64_t DeskService::take_handle(grpc::ServerContext& context) {
  const std::lock_guard lock(mutex_);
  const std::chrono::duration<double> silence = Clock::now() - said_;
  if (held_ && silence.count() <= kHandAgeMax_s) return 0;
  if (holder_ != nullptr && hands_there_ > kSilentHandsMax) holder_->TryCancel();
  holder_ = &context;
  held_ = true;
  said_ = Clock::now();
  return ++hands_;
}

bool DeskService::pass(std::uint64_t hand, const RemoteAim& aim) {
  const std::lock_guard lock(mutex_);
  if (hand != hands_) return false;
  held_ = aim.holds;
  said_ = Clock::now();
  RemoteAim numbered = aim;
  numbered.hand = hand;
  aim_(numbered);
  return true;
}

}  // namespace longreach
