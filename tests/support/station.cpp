#include "tests/support/station.hpp"

#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <thread>

#include "common/rpc/rpc_channel.hpp"

namespace longreach {
namespace {

constexpr auto kCallTimeout = std::chrono::seconds(5);

void limit(grpc::ClientContext& context) {
  context.set_deadline(std::chrono::system_clock::now() + kCallTimeout);
  context.set_wait_for_ready(true);
}

}  // namespace

StationSide::StationSide(RpcRole role, int port)
    : stub_(proto::Control::NewStub(
          connect_rpc("127.0.0.1:" + std::to_string(port), role, test_site(RpcRole::kClient)))) {}

std::optional<proto::Status> StationSide::status() {
  grpc::ClientContext context;
  limit(context);
  proto::Status status;
  return stub_->GetStatus(&context, {}, &status).ok() ? std::optional(status) : std::nullopt;
}

std::string StationSide::engage() {
  grpc::ClientContext context;
  limit(context);
  proto::Outcome outcome;
  proto::Action action;
  action.mutable_engage();
  return stub_->Do(&context, action, &outcome).error_message();
}

std::string StationSide::stop() {
  grpc::ClientContext context;
  limit(context);
  proto::Outcome outcome;
  return stub_->Stop(&context, {}, &outcome).error_message();
}

std::string StationSide::set(const std::string& path, const std::string& value) {
  return set({{path, value}});
}

std::string StationSide::set(const std::vector<std::pair<std::string, std::string>>& assignments) {
  grpc::ClientContext context;
  limit(context);
  proto::Action action;
  for (const auto& [path, value] : assignments) {
    auto* assignment = action.mutable_set()->add_assignment();
    assignment->set_path(path);
    assignment->set_value(value);
  }
  proto::Outcome outcome;
  return stub_->Do(&context, action, &outcome).error_message();
}

std::string StationSide::get(const std::string& path) {
  grpc::ClientContext context;
  limit(context);
  proto::GetConfigRequest request;
  request.set_path(path);
  proto::GetConfigResponse response;
  return stub_->GetConfig(&context, request, &response).ok() ? response.text() : "unreachable";
}

std::string StationSide::set_delay(double delay_s) {
  grpc::ClientContext context;
  limit(context);
  proto::Action action;
  action.mutable_link()->set_replace(true);
  action.mutable_link()->mutable_impairment()->set_delay_s(delay_s);
  proto::Outcome outcome;
  return stub_->Do(&context, action, &outcome).error_message();
}

std::string StationSide::state() {
  const auto now = status();
  return now ? now->state() : "unreachable";
}

std::uint64_t StationSide::counter(const std::string& name) {
  const auto now = status();
  if (!now) return 0;
  for (const auto& counter : now->counters()) {
    if (counter.name() == name) return counter.count();
  }
  return 0;
}

void Station::start_slave(const std::vector<std::string>& more, const Streams& streams) {
  std::vector<std::string> arguments = {"--set", "link.listen=" + link_address(), "--set",
                                        "rpc.listen=127.0.0.1:" + std::to_string(ports_.slave_rpc)};
  arguments.insert(arguments.end(), more.begin(), more.end());
  slave_program_ = std::make_unique<RunningProgram>("longreach-slave", arguments, streams);
}

void Station::start_master(const std::vector<std::string>& more, const Streams& streams) {
  std::vector<std::string> arguments = {
      "--set", "link.slave=" + link_address(),
      "--set", "link.slave_rpc=127.0.0.1:" + std::to_string(ports_.slave_rpc),
      "--set", "link.listen=127.0.0.1:0",
      "--set", "rpc.listen=127.0.0.1:" + std::to_string(ports_.master_rpc)};
  if (std::ranges::find(more, "--view") == more.end()) arguments.insert(arguments.end(), {"--view", "none"});
  arguments.insert(arguments.end(), more.begin(), more.end());
  master_program_ = std::make_unique<RunningProgram>("longreach-master", arguments, streams);
}

bool Station::eventually(const std::function<bool()>& holds, std::chrono::seconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (!holds()) {
    if (std::chrono::steady_clock::now() >= deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

bool Station::both_engaged(std::chrono::seconds timeout) {
  return eventually([this] { return slave_.state() == "Engaged" && master_.state() == "Engaged"; }, timeout);
}

bool Station::engaged() {
  return eventually([this] { return master_.engage().empty() && both_engaged(std::chrono::seconds(10)); });
}

bool Station::says(const RunningProgram& program, const std::string& words) {
  return eventually([&] { return program.output().find(words) != std::string::npos; });
}

std::string Station::outputs() const {
  std::string text;
  if (slave_program_) text += "slave:\n" + slave_program_->output();
  if (master_program_) text += "master:\n" + master_program_->output();
  return text;
}

}  // namespace longreach
