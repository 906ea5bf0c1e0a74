#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <actionlib/client/simple_action_client.h>
#include <split_mapf/PlanPathsAction.h>
#include <split_mapf/RobotTask.h>

namespace split_mapf {

/// Asks the action PlanPaths for plans on the latest map of its server. Nothing here waits: the
/// client has a thread of its own, on which `said` is called. Thread-safe but for its construction
/// and end.
class PlanAsker {
 public:
  /// @param said  takes one sentence: how far the goal is, or how it ended.
  explicit PlanAsker(std::function<void(const std::string&)> said) : said_(std::move(said)) {}

  /// Chooses the server; asks nothing yet, so that it can be found meanwhile.
  void choose(const std::string& action);
  /// Sends a goal and cancels the former one of this object. Says so when there is no server.
  void ask(const std::vector<RobotTask>& robots, double time_limit_sec);

 private:
  using Client = actionlib::SimpleActionClient<PlanPathsAction>;

  std::function<void(const std::string&)> said_;
  std::string action_;
  std::atomic<bool> has_ended_{true};
  std::unique_ptr<Client> client_;
};

}  // namespace split_mapf
