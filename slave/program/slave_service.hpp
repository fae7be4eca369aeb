#pragma once
// Operations of the slave for RPC clients: queries, tighter limits, an artificial impairment of the link, and
// a stop. Engagement, mode and scale can be changed only at the master.

#include <mutex>

#include "common/rpc/side_service.hpp"
#include "slave/program/slave_shell.hpp"

namespace longreach {

class SlaveService : public SideService<SlaveShell> {
 public:
  using SideService::SideService;

  proto::Status status() override;
  std::variant<proto::OpenSessionResponse, Refusal> open_session(const proto::OpenSessionRequest& request,
                                                                 const std::string& caller) override;
  std::optional<Refusal> close_session(std::uint64_t session) override;

  /// Address of the master that controls the robot; empty if there is none.
  [[nodiscard]] std::string lease() const;

 private:
  std::optional<Refusal> check(const Assignments& assignments, Change& change) override;
  std::variant<std::string, Refusal> act(const proto::Action& action) override;
  Refusal occupied(const std::string& caller);
  void set_lease(const std::string& holder);

  mutable std::mutex leasing_;
  std::string lease_;
  std::string refused_;  // address of the last master that was refused
};

}  // namespace longreach
