#include "solver/ecbs/ecbs_search.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace split_mapf {
namespace {

constexpr std::uint32_t kNoPath = 0xffffffffU;
// A robot may go this many steps round before more weighs like a collision. Measured for sum of
// costs: with 0 searches of ost003d with 300 robots do not end, without a limit they cost 2 % more.
constexpr std::uint32_t kCheapDetour = 10;
// For makespan so many steps more weigh like one collision, as they cost nothing while the bound is
// kept. Measured: sums of costs fall from 1.16 to 1.02 times the bound (den520d, 500 robots) and
// the makespan stays; with 1 it rises on three of nine cells.
constexpr std::uint32_t kMakespanSteps = 10;
// Every so many nodes the one of the least lower bound is expanded instead of the best of FOCAL:
// otherwise FOCAL can descend for ever below a bound that nobody raises.
constexpr std::uint64_t kRaiseEvery = 4;

std::uint32_t lengthOf(const Path& path) { return static_cast<std::uint32_t>(path.size()) - 1; }

}  // namespace

EcbsSearch::EcbsSearch(const Instance& instance, Objective objective, double suboptimality,
                       std::uint64_t expansion_limit, const Deadline& deadline)
    : instance_(instance),
      objective_(objective),
      expansion_limit_(expansion_limit),
      deadline_(deadline),
      tree_(suboptimality),
      table_(instance.graph().size()),
      search_(instance.graph()),
      finder_(instance.robots()),
      path_of_(instance.robots(), kNoPath),
      bound_of_(instance.robots(), 0),
      wanted_path_(instance.robots(), kNoPath),
      seen_path_(instance.robots(), 0),
      seen_bound_(instance.robots(), 0) {}

SolveResult EcbsSearch::run() {
  SolveResult result;
  bool done = false;
  std::uint64_t lower_bound = lowerBound(instance_, objective_);
  if (plantRoot()) {
    while (!done && !interrupted_ && !tree_.empty()) {
      lower_bound = tree_.lowerBound();
      const bool raise = result.high_level_nodes % kRaiseEvery == kRaiseEvery - 1;
      const std::uint32_t node = raise ? tree_.lowest() : tree_.best();
      ++result.high_level_nodes;
      done = expand(node, result);
    }
  }
  if (!done && exhausted_) {
    result = outOfExpansions(expansion_limit_);
  } else if (!done) {
    result.termination = interrupted_ ? interruptionOf(deadline_) : Termination::kUnsolvable;
    if (!interrupted_) result.message = "the constraint tree is exhausted: no plan exists";
  }
  return finish(std::move(result), lower_bound);
}

SolveResult EcbsSearch::finish(SolveResult result, std::uint64_t lower_bound) {
  result.lower_bound = lower_bound;
  result.low_level_expansions = expansions_;
  certifyByLowerBound(result, objective_, "ecbs");
  return result;
}

bool EcbsSearch::plantRoot() {
  std::vector<std::uint32_t> order(instance_.robots());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return instance_.shortestLength(a) > instance_.shortestLength(b);
  });
  TreeNode root;
  root.lower_bound = lowerBound(instance_, objective_);
  for (const std::uint32_t robot : order) {
    interrupted_ = interrupted_ || deadline_.expired();
    if (interrupted_) return false;
    bound_of_[robot] = instance_.shortestLength(robot);
    SearchQuery query = queryFor(robot);
    limitArrival(query, objective_ == Objective::kMakespan
                            ? static_cast<std::uint32_t>(root.lower_bound)
                            : bound_of_[robot]);
    Path path = runSearch(query);
    if (interrupted_) return false;
    finder_.find(robot, path, table_, root.conflicts);
    root.cost = objective_ == Objective::kMakespan
                    ? std::max<std::uint64_t>(root.cost, lengthOf(path))
                    : root.cost + lengthOf(path);
    root.paths.emplace_back(robot, tree_.addPath(std::move(path)));
    usePath(robot, root.paths.back().second);
  }
  tree_.add(std::move(root));
  return true;
}

void EcbsSearch::usePath(std::uint32_t robot, std::uint32_t number) {
  if (path_of_[robot] == number) return;
  if (path_of_[robot] != kNoPath) table_.remove(robot, tree_.path(path_of_[robot]));
  table_.insert(robot, tree_.path(number));
  path_of_[robot] = number;
}

void EcbsSearch::load(std::uint32_t node) {
  ++loads_;
  for (std::uint32_t robot = 0; robot < instance_.robots(); ++robot) {
    bound_of_[robot] = instance_.shortestLength(robot);
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
  }
  for (std::uint32_t robot = 0; robot < instance_.robots(); ++robot) {
    usePath(robot, wanted_path_[robot]);
  }
}

bool EcbsSearch::expand(std::uint32_t node, SolveResult& result) {
  load(node);
  while (!tree_.node(node).conflicts.empty()) {
    const Branches branches = branchOn(choose(tree_.node(node)));
    std::optional<Child> first = makeChild(node, branches.first);
    if (interrupted_) return false;
    if (first && adoptInstead(node, *first)) continue;
    std::optional<Child> second = makeChild(node, branches.second);
    if (interrupted_) return false;
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
  Plan plan;
  for (const std::uint32_t number : path_of_) plan.paths.push_back(tree_.path(number));
  result.plan = std::move(plan);
  result.termination = Termination::kSolved;
  return true;
}

bool EcbsSearch::adoptInstead(std::uint32_t number, Child& child) {
  TreeNode& node = tree_.node(number);
  if (child.node.conflicts.size() >= node.conflicts.size()) return false;
  const std::uint32_t robot = child.node.constraint.robot;
  const std::uint64_t robot_limit = objective_ == Objective::kMakespan
                                        ? tree_.limit(node.lower_bound)
                                        : tree_.limit(bound_of_[robot]);
  if (lengthOf(child.path) > robot_limit) return false;
  if (child.node.cost > tree_.limit(tree_.lowerBound())) return false;
  // A longer makespan is for a child to try, not for its parent to be stuck with.
  const bool longer = child.node.cost > std::max(node.cost, node.lower_bound);
  if (objective_ == Objective::kMakespan && longer) return false;
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
  gatherConstraints(parent, constraint.robot);
  apply(constraint, constraints_);
  if (deadline_.expired()) interrupted_ = true;
  if (interrupted_ || !planChild(parent, child) || interrupted_) return std::nullopt;
  completeChild(parent, child);
  return child;
}

void EcbsSearch::gatherConstraints(std::uint32_t node, std::uint32_t robot) {
  constraints_.clear();
  for (std::uint32_t i = node; tree_.node(i).parent != TreeNode::kNoParent;
       i = tree_.node(i).parent) {
    if (tree_.node(i).constraint.robot == robot) apply(tree_.node(i).constraint, constraints_);
  }
}

bool EcbsSearch::planChild(std::uint32_t parent, Child& child) {
  SearchQuery query = queryFor(child.node.constraint.robot);
  query.constraints = &constraints_;
  return objective_ == Objective::kMakespan ? planForMakespan(tree_.node(parent), query, child)
                                            : planForSumOfCosts(tree_.node(parent), query, child);
}

bool EcbsSearch::planForMakespan(const TreeNode& parent, SearchQuery& query, Child& child) {
  const auto bound = static_cast<std::uint32_t>(parent.lower_bound);
  limitArrival(query, bound);
  child.path = runSearch(query);
  child.node.robot_bound = bound_of_[query.robot];
  child.node.lower_bound = bound;
  if (!child.path.empty() && lengthOf(child.path) <= bound) return true;
  // Only a robot that cannot keep the bound can raise it.
  child.node.robot_bound = shortestUnderConstraints(query);
  if (child.node.robot_bound == kForever) return false;
  child.node.lower_bound = std::max(bound, child.node.robot_bound);
  if (!child.path.empty()) return true;
  limitArrival(query, static_cast<std::uint32_t>(child.node.lower_bound));
  child.path = runSearch(query);
  return !child.path.empty();
}

bool EcbsSearch::planForSumOfCosts(const TreeNode& parent, SearchQuery& query, Child& child) {
  const std::uint32_t bound = shortestUnderConstraints(query);
  if (bound == kForever) return false;
  child.node.robot_bound = bound;
  child.node.lower_bound = parent.lower_bound + bound - bound_of_[query.robot];
  limitArrival(query, bound);
  child.path = runSearch(query);
  return !child.path.empty();
}

std::uint32_t EcbsSearch::shortestUnderConstraints(SearchQuery query) {
  query.mode = OthersAre::kIgnored;
  query.latest_arrival = kForever - 1;
  query.cheap_arrival = kForever;
  const Path path = runSearch(query);
  return path.empty() ? kForever : lengthOf(path);
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
  if (objective_ == Objective::kSumOfCosts) {
    child.node.cost = node.cost + lengthOf(child.path) - lengthOf(tree_.path(path_of_[robot]));
    return;
  }
  child.node.cost = lengthOf(child.path);
  for (std::uint32_t other = 0; other < instance_.robots(); ++other) {
    if (other == robot) continue;
    child.node.cost =
        std::max<std::uint64_t>(child.node.cost, lengthOf(tree_.path(path_of_[other])));
  }
}

const Conflict& EcbsSearch::choose(const TreeNode& node) const {
  return *std::min_element(node.conflicts.begin(), node.conflicts.end(),
                           [](const Conflict& a, const Conflict& b) { return a.step < b.step; });
}

SearchQuery EcbsSearch::queryFor(std::uint32_t robot) const {
  SearchQuery query;
  query.robot = robot;
  query.start = instance_.start(robot);
  query.distances = &instance_.distances(robot);
  query.others = &table_;
  query.mode = OthersAre::kCounted;
  return query;
}

void EcbsSearch::limitArrival(SearchQuery& query, std::uint32_t bound) const {
  query.latest_arrival = static_cast<std::uint32_t>(tree_.limit(bound));
  query.cheap_arrival = bound + kCheapDetour;
  if (objective_ == Objective::kMakespan) {
    query.cheap_arrival = bound_of_[query.robot] + kCheapDetour;
    query.firm_arrival = bound;
    query.steps_a_collision = kMakespanSteps;
  }
}

Path EcbsSearch::runSearch(const SearchQuery& query) {
  SearchAnswer answer = search_.search(query, deadline_);
  expansions_ += answer.expansions;
  exhausted_ = exhausted_ || (expansion_limit_ > 0 && expansions_ > expansion_limit_);
  if (answer.interrupted || exhausted_) interrupted_ = true;
  return std::move(answer.path);
}

}  // namespace split_mapf
