#include "solver/ecbs/ecbs_search.h"

#include <algorithm>
#include <string>
#include <utility>

#include "solver/joint/joint_search.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kNoPath = 0xffffffffU;
// What a search over joint states may take: seconds, and some 100 MB.
constexpr std::uint64_t kJointStates = 1000000;
constexpr std::uint64_t kJointMoves = 100000000;
// Joint moves that take as long as an expansion of a single robot's search.
constexpr std::uint64_t kMovesAnExpansion = 10;

std::uint32_t lengthOf(const Path& path) { return static_cast<std::uint32_t>(path.size()) - 1; }

}  // namespace

EcbsSearch::EcbsSearch(EcbsRun& run, GroupTask task)
    : run_(run),
      instance_(run.instance),
      settings_(run.settings),
      table_(run.table),
      low_level_(run.low_level),
      robots_(std::move(task.robots)),
      first_bound_(task.lower_bound),
      tree_(settings_, task.others_bound, task.others_cost),
      finder_(instance_.robots(), settings_.targets),
      cardinality_(instance_, run.deadline, tree_),
      corridors_(instance_),
      path_of_(instance_.robots(), kNoPath),
      bound_of_(instance_.robots(), 0),
      constrained_at_(instance_.robots(), TreeNode::kNoParent),
      wanted_path_(instance_.robots(), kNoPath),
      seen_path_(instance_.robots(), 0),
      seen_bound_(instance_.robots(), 0) {
  finder_.attendOnlyTo(robots_);
  plantRoot(std::move(task.conflicts));
}

SolveResult EcbsSearch::run(std::uint64_t most_nodes) {
  SolveResult result;
  result.lower_bound = first_bound_;
  bool done = false;
  while (!done && !low_level_.stopped() && !tree_.empty()) {
    if (most_nodes > 0 && result.high_level_nodes == most_nodes) return result;
    result.lower_bound = tree_.lowerBound();
    // Otherwise FOCAL can descend for ever below a bound that nobody raises.
    const bool raise = settings_.raise_every > 0 &&
                       result.high_level_nodes % settings_.raise_every == settings_.raise_every - 1;
    const std::uint32_t node = raise ? tree_.lowest() : tree_.best();
    ++result.high_level_nodes;
    done = expand(node);
  }
  if (done) {
    handOver();
    result.termination = Termination::kSolved;
  } else if (low_level_.stopped()) {
    result.termination = interruptionOf(run_.deadline);
  } else {
    result.termination = Termination::kUnsolvable;
    result.message = "the constraint tree is exhausted: no plan exists";
  }
  return result;
}

void EcbsSearch::plantRoot(std::vector<Conflict> conflicts) {
  TreeNode root;
  root.conflicts = std::move(conflicts);
  for (const std::uint32_t robot : robots_) {
    const std::uint32_t cost = lengthOf(run_.paths[robot]);
    const bool makespan = ruleOf(settings_.objective).greatest_only;
    root.cost = makespan ? std::max<std::uint64_t>(root.cost, cost) : root.cost + cost;
    root.bound_sum += run_.reserved.soonestArrival(robot);
    path_of_[robot] = tree_.addPath(run_.paths[robot]);
    root.paths.emplace_back(robot, path_of_[robot]);
  }
  root.lower_bound = first_bound_;
  tree_.add(std::move(root));
}

void EcbsSearch::leaveTable() {
  for (const std::uint32_t robot : robots_) {
    if (path_of_[robot] != kNoPath) table_.remove(robot, tree_.path(path_of_[robot]));
    path_of_[robot] = kNoPath;
  }
}

bool EcbsSearch::searchJointStates(SolveResult& result) {
  leaveTable();
  JointTask task;
  task.robots = robots_;
  task.others = &table_;
  if (ruleOf(settings_.objective).greatest_only) task.floor = first_bound_;
  JointSettings settings;
  settings.objective = settings_.objective;
  settings.states = kJointStates;
  // The rest of the run's limit, and one look more to use it up.
  settings.expansion_limit =
      std::min(kJointMoves / kMovesAnExpansion, low_level_.left()) * kMovesAnExpansion + 1;
  JointSearch search(instance_, std::move(task), settings, run_.deadline);
  const JointSearch::Outcome outcome = search.run();
  low_level_.count(search.expansions() / kMovesAnExpansion);
  result.lower_bound = std::max(result.lower_bound, search.lowerBound());
  if (outcome == JointSearch::Outcome::kNone) {
    result.termination = Termination::kUnsolvable;
    result.message = "no plan exists: all joint states of " + std::to_string(robots_.size()) +
                     " robots were searched";
    return true;
  }
  if (outcome != JointSearch::Outcome::kFound) return false;
  std::vector<Path> paths = search.paths();
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    run_.paths[robots_[i]] = std::move(paths[i]);
    table_.insert(robots_[i], run_.paths[robots_[i]]);
  }
  run_.joint = true;
  result.termination = Termination::kSolved;
  return true;
}

void EcbsSearch::handOver() {
  for (const std::uint32_t robot : robots_) run_.paths[robot] = tree_.path(path_of_[robot]);
}

void EcbsSearch::usePath(std::uint32_t robot, std::uint32_t number) {
  if (path_of_[robot] == number) return;
  if (path_of_[robot] != kNoPath) table_.remove(robot, tree_.path(path_of_[robot]));
  table_.insert(robot, tree_.path(number));
  path_of_[robot] = number;
}

void EcbsSearch::load(std::uint32_t node) {
  ++loads_;
  for (const std::uint32_t robot : robots_) {
    bound_of_[robot] = run_.reserved.soonestArrival(robot);
    constrained_at_[robot] = TreeNode::kNoParent;
  }
  for (std::uint32_t i = node; i != TreeNode::kNoParent; i = tree_.node(i).parent) {
    const TreeNode& at = tree_.node(i);
    for (auto path = at.paths.rbegin(); path != at.paths.rend(); ++path) {
      if (seen_path_[path->first] == loads_) continue;
      seen_path_[path->first] = loads_;
      wanted_path_[path->first] = path->second;
    }
    if (at.parent == TreeNode::kNoParent) continue;
    if (seen_bound_[at.constraint.robot] == loads_) continue;
    seen_bound_[at.constraint.robot] = loads_;
    bound_of_[at.constraint.robot] = at.robot_bound;
    constrained_at_[at.constraint.robot] = i;
  }
  for (const std::uint32_t robot : robots_) {
    usePath(robot, wanted_path_[robot]);
  }
}

bool EcbsSearch::expand(std::uint32_t node) {
  load(node);
  while (!tree_.node(node).conflicts.empty()) {
    const std::optional<Conflict> conflict = choose(node);
    if (!conflict || low_level_.stopped()) return false;
    const Branches branches = branchesOf(node, *conflict);
    std::optional<Child> first = makeChild(node, branches.first);
    if (low_level_.stopped()) return false;
    if (first && adoptInstead(node, *first)) continue;
    std::optional<Child> second = makeChild(node, branches.second);
    if (low_level_.stopped()) return false;
    if (second && adoptInstead(node, *second)) continue;
    for (std::optional<Child>* child : {&first, &second}) {
      if (!*child) continue;
      (*child)->node.paths.emplace_back((*child)->node.constraint.robot,
                                        tree_.addPath(std::move((*child)->path)));
      tree_.add(std::move((*child)->node));
    }
    tree_.close(node);
    return false;
  }
  return true;
}

Branches EcbsSearch::branchesOf(std::uint32_t node, const Conflict& conflict) {
  if (!settings_.corridor) return branchOn(conflict);
  const auto traveller = [&](std::uint32_t robot, RobotConstraints& constraints) {
    constraints.clear();
    tree_.gatherConstraints(node, robot, constraints);
    return CorridorReasoning::Traveller{robot, tree_.path(path_of_[robot]), constraints};
  };
  const std::uint64_t before = corridors_.expansions();
  const std::optional<Branches> branches =
      corridors_.branchOn(conflict, traveller(conflict.first, constraints_),
                          traveller(conflict.second, others_constraints_));
  low_level_.count(corridors_.expansions() - before);
  return branches ? *branches : branchOn(conflict);
}

bool EcbsSearch::adoptInstead(std::uint32_t number, Child& child) {
  if (!settings_.bypass) return false;
  TreeNode& node = tree_.node(number);
  if (child.node.conflicts.size() >= node.conflicts.size()) return false;
  const std::uint32_t robot = child.node.constraint.robot;
  const std::uint64_t robot_limit = ruleOf(settings_.objective).greatest_only
                                        ? settings_.limit(node.lower_bound)
                                        : settings_.limit(bound_of_[robot]);
  if (lengthOf(child.path) > robot_limit) return false;
  if (child.node.cost > tree_.limit(tree_.lowerBound())) return false;
  // A longer makespan is for a child to try, not for its parent to be stuck with.
  const bool longer = child.node.cost > std::max(node.cost, node.lower_bound);
  if (ruleOf(settings_.objective).greatest_only && longer) return false;
  node.cost = child.node.cost;
  node.conflicts = std::move(child.node.conflicts);
  node.paths.emplace_back(robot, tree_.addPath(std::move(child.path)));
  usePath(robot, node.paths.back().second);
  return true;
}

std::optional<EcbsSearch::Child> EcbsSearch::makeChild(std::uint32_t parent,
                                                       const Constraint& constraint) {
  Child child;
  child.node.parent = parent;
  child.node.constraint = constraint;
  constraints_.clear();
  tree_.gatherConstraints(parent, constraint.robot, constraints_);
  apply(constraint, constraints_);
  if (low_level_.stopped() || !planChild(parent, child) || low_level_.stopped())
    return std::nullopt;
  completeChild(parent, child);
  return child;
}

bool EcbsSearch::planChild(std::uint32_t parent, Child& child) {
  return ruleOf(settings_.objective).greatest_only ? planForMakespan(tree_.node(parent), child)
                                                   : planForSumOfCosts(tree_.node(parent), child);
}

bool EcbsSearch::planForMakespan(const TreeNode& parent, Child& child) {
  const std::uint32_t robot = child.node.constraint.robot;
  const auto bound = static_cast<std::uint32_t>(parent.lower_bound);
  child.path = fewestCollisions(robot, bound, bound_of_[robot]);
  child.node.robot_bound = bound_of_[robot];
  child.node.lower_bound = bound;
  if (!child.path.empty() && lengthOf(child.path) <= bound) return true;
  // Only a robot that cannot keep the bound can raise it.
  child.node.robot_bound = shortestUnderConstraints(robot);
  if (child.node.robot_bound == kForever) return false;
  child.node.lower_bound = std::max(bound, child.node.robot_bound);
  if (!child.path.empty()) return true;
  child.path =
      fewestCollisions(robot, static_cast<std::uint32_t>(child.node.lower_bound), bound_of_[robot]);
  return !child.path.empty();
}

bool EcbsSearch::planForSumOfCosts(const TreeNode& parent, Child& child) {
  const std::uint32_t robot = child.node.constraint.robot;
  const std::uint32_t bound = shortestUnderConstraints(robot);
  if (bound == kForever) return false;
  child.node.robot_bound = bound;
  child.node.bound_sum = parent.bound_sum + bound - bound_of_[robot];
  child.node.lower_bound = std::max(parent.lower_bound, child.node.bound_sum);
  child.path = fewestCollisions(robot, bound, bound);
  return !child.path.empty();
}

std::uint32_t EcbsSearch::shortestUnderConstraints(std::uint32_t robot) {
  SearchQuery query = low_level_.shortest(robot);
  query.constraints = &constraints_;
  const Path path = low_level_.run(query);
  return path.empty() ? kForever : lengthOf(path);
}

Path EcbsSearch::fewestCollisions(std::uint32_t robot, std::uint32_t bound,
                                  std::uint32_t own_bound) {
  SearchQuery query = low_level_.fewestCollisions(robot, bound, own_bound);
  query.constraints = &constraints_;
  return low_level_.run(query);
}

void EcbsSearch::completeChild(std::uint32_t parent, Child& child) {
  const std::uint32_t robot = child.node.constraint.robot;
  const TreeNode& node = tree_.node(parent);
  for (const Conflict& conflict : node.conflicts) {
    if (conflict.first != robot && conflict.second != robot) {
      child.node.conflicts.push_back(conflict);
    }
  }
  finder_.find(robot, child.path, table_, child.node.conflicts);
  if (ruleOf(settings_.objective).sums()) {
    child.node.cost = node.cost + lengthOf(child.path) - lengthOf(tree_.path(path_of_[robot]));
    return;
  }
  child.node.cost = lengthOf(child.path);
  for (const std::uint32_t other : robots_) {
    if (other == robot) continue;
    child.node.cost =
        std::max<std::uint64_t>(child.node.cost, lengthOf(tree_.path(path_of_[other])));
  }
}

std::optional<Conflict> EcbsSearch::choose(std::uint32_t number) {
  TreeNode& node = tree_.node(number);
  if (!settings_.cardinal || ruleOf(settings_.objective).greatest_only) {
    return *std::min_element(node.conflicts.begin(), node.conflicts.end(),
                             [](const Conflict& a, const Conflict& b) { return a.step < b.step; });
  }
  const std::uint64_t before = cardinality_.expansions();
  const ConflictRanking ranking = cardinality_.rank(node, {bound_of_, constrained_at_});
  low_level_.count(cardinality_.expansions() - before);
  if (settings_.matching) {
    const std::uint64_t bound = node.bound_sum + ranking.surplus;
    if (bound > tree_.limit(tree_.lowerBound())) {
      tree_.reopen(number, bound);
      return std::nullopt;
    }
    node.lower_bound = std::max(node.lower_bound, bound);
  }
  return node.conflicts[ranking.chosen];
}

}  // namespace split_mapf
