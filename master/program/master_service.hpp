#pragma once
// Operations of the master for RPC clients and keys: status, configuration, impairment of the link, mode,
// scale, engage, stop, sessions and recordings.

#include <mutex>

#include "common/rpc/side_service.hpp"
#include "master/console/situation.hpp"
#include "master/program/master_shell.hpp"

namespace longreach {

class MasterService : public SideService<MasterShell> {
 public:
  using SideService::SideService;

  proto::Status status() override;
  std::variant<proto::OpenSessionResponse, Refusal> open_session(const proto::OpenSessionRequest& request,
                                                                 const std::string& caller) override;
  std::optional<Refusal> close_session(std::uint64_t session) override;

  /// Passes requests to the loop. Returns the reason if they are refused. May be called from any thread
  /// except the loop thread.
  std::optional<Refusal> request(const OperatorRequests& requests);
  /// Passes a session to the loop. Returns false if the loop did not respond. May be called from any thread
  /// except the loop thread.
  bool adopt(const Session& session);
  /// Returns why there is no session with the slave, or another problem with the link or the hand; empty if
  /// there is no problem.
  std::string trouble();
  /// Sets the text that trouble() returns, and the address of the other master that has control of the robot.
  /// Empty means none.
  void put_trouble(const std::string& trouble, const std::string& taken_by);
  /// What is shown to the operator.
  Shown shown();
  void put_shown(const Shown& shown);

 private:
  std::optional<Refusal> check(const Assignments& assignments, Change& change) override;
  std::variant<std::string, Refusal> act(const proto::Action& action) override;
  std::optional<Refusal> engage();

  std::mutex troubling_;
  std::string trouble_, taken_by_;
  Shown shown_{};
};

}  // namespace longreach
