#include "deploy/cli/frames.hpp"

#include <grpcpp/grpcpp.h>

#include <memory>

#include "proto/control.grpc.pb.h"

namespace longreach {

std::string follow_frames(const Options& options, double rate_hz, const std::atomic<bool>& ended,
                          const std::function<bool(grpc::ClientContext*)>& opened,
                          const std::function<bool(const proto::Frame&)>& frame) {
  try {
    const auto connection = connection_to(Side::kMaster, options);
    const auto stub = proto::Desk::NewStub(connection->channel());
    const auto progress = connection->connect(options.timeout_s, ended);
    grpc::ClientContext context;
    if (!progress.connected) context.set_deadline(progress.call_until);
    if (!opened(&context)) return "";
    const std::shared_ptr<void> closes(nullptr, [&](void*) { opened(nullptr); });
    proto::FollowRequest request;
    request.set_rate_hz(rate_hz);
    const auto stream = stub->Follow(&context, request);
    bool goes_on = true;
    for (proto::Frame next; goes_on && stream->Read(&next);) goes_on = frame(next);
    if (!goes_on) context.TryCancel();
    const grpc::Status end = stream->Finish();
    return goes_on ? failure(Side::kMaster, options, context, end, progress).what() : "";
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace longreach
