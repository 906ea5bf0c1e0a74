#include "solver/ilp/arc_flow_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/ilp/node_queue.h"
#include "solver/ilp/window.h"
#include "split_mapf/core/validate.h"

namespace split_mapf::ilp {
namespace {

constexpr double kIntegral = 1e-5;
constexpr std::uint64_t kPollEvery = 256;
// Measured: GLPK's own structures with their factorisation, and ours.
constexpr std::uint64_t kBytesAVariable = 1200;

std::uint32_t greatest(const std::vector<std::uint32_t>& numbers) {
  return *std::max_element(numbers.begin(), numbers.end());
}

}  // namespace

ArcFlowSearch::ArcFlowSearch(const Instance& instance, Objective objective,
                             std::vector<std::uint32_t> latest, std::uint64_t cost_limit,
                             const Effort& effort)
    : instance_(instance),
      objective_(objective),
      latest_(std::move(latest)),
      cost_limit_(cost_limit),
      effort_(effort),
      space_(instance.graph(), greatest(latest_)),
      model_(effort.deadline, effort.memory_mb),
      separator_(space_) {}

std::uint64_t ArcFlowSearch::leastMemoryBytes(const Instance& instance,
                                              const std::vector<std::uint32_t>& latest) {
  const MoveSpace any(instance.graph(), 0);
  std::uint64_t variables = 0;
  for (std::uint32_t i = 0; i < instance.robots(); ++i) {
    const Window window(instance, i, latest[i], any.slots());
    for (std::uint32_t place = 0; place < window.size(); ++place) {
      const std::uint32_t* source = window.sources(place);
      const auto moves = static_cast<std::uint64_t>(
          any.slots() - std::count(source, source + any.slots(), Window::kNowhere));
      variables += moves * (window.last(place) - window.first(place) + 1);
    }
  }
  return variables * kBytesAVariable +
         2 * sizeof(double) * MoveSpace::count(instance.graph(), greatest(latest));
}

SearchEnd ArcFlowSearch::run() {
  build();
  std::vector<Node> open = {{}};
  while (!open.empty() && !stopped()) {
    const Node node = open.back();
    open.pop_back();
    enter(node);
    ++counts_.nodes;
    const Verdict verdict = solveRelaxation();
    if (verdict == Verdict::kStopped) break;
    if (verdict == Verdict::kPruned) continue;
    const int variable = mostFractional();
    if (variable >= 0) {
      open.push_back({fixed_.size(), variable, 0});
      open.push_back({fixed_.size(), variable, 1});
      continue;
    }
    accept();
    if (ruleOf(objective_).greatest_only) break;
  }
  return end_;
}

bool ArcFlowSearch::stopped() {
  if (effort_.deadline.expired()) {
    end_ = SearchEnd::kInterrupted;
  } else if (effort_.expansions > 0 && counts_.expansions > effort_.expansions) {
    end_ = SearchEnd::kEffort;
  }
  return end_ != SearchEnd::kExhausted;
}

void ArcFlowSearch::build() {
  for (std::uint32_t i = 0; i < instance_.robots() && !stopped(); ++i) buildRobot(i);
}

/// Flow conservation in every state of the robot's window, its moves, and its arrivals.
void ArcFlowSearch::buildRobot(std::uint32_t robot) {
  const Window window(instance_, robot, latest_[robot], space_.slots());
  std::vector<int> first_row(window.size());
  for (std::uint32_t place = 0; place < window.size(); ++place) {
    first_row[place] = model_.rows();
    for (std::uint32_t t = window.first(place); t <= window.last(place); ++t) {
      const bool start = place == 0 && t == 0;
      model_.addRow(RowKind::kEqual, start ? -1 : 0, {});  // what comes in less what goes out
    }
  }
  const auto row_of = [&](std::uint32_t place, std::uint32_t t) {
    return first_row[place] + static_cast<int>(t - window.first(place));
  };
  for (std::uint32_t place = 0; place < window.size() && !stopped(); ++place) {
    for (std::uint32_t slot = 0; slot < space_.slots(); ++slot) {
      const std::uint32_t from = window.sources(place)[slot];
      if (from == Window::kNowhere) continue;
      const std::uint32_t end = std::min(window.last(from), window.last(place) - 1);
      for (std::uint32_t t = window.first(from); t <= end && window.last(place) > 0; ++t) {
        if (t + 1 < window.first(place)) continue;
        addVariable(robot, false, {space_.into(t, window.vertex(place)) + slot}, 0,
                    {{row_of(from, t), row_of(place, t + 1)}, {-1, 1}});
      }
    }
  }
  const std::uint32_t goal = window.goalPlace();
  for (std::uint32_t t = window.first(goal); t <= window.last(goal); ++t) {
    std::vector<MoveId> waits;
    for (std::uint32_t s = t; s < space_.horizon(); ++s) {
      waits.push_back(space_.into(s, window.vertex(goal)));
    }
    const double cost = ruleOf(objective_).greatest_only ? 0.0 : t;
    addVariable(robot, true, std::move(waits), cost, {{row_of(goal, t)}, {-1}});
  }
}

int ArcFlowSearch::addVariable(std::uint32_t robot, bool arrival, std::vector<MoveId> moves,
                               double cost, const Coefficients& rows) {
  const int column = model_.addColumn(cost, rows);
  for (const MoveId move : moves) variables_of_[move].push_back(column);
  variables_.push_back({robot, arrival, std::move(moves)});
  return column;
}

/// Takes back what is fixed below the node's parent and fixes the node's variable.
void ArcFlowSearch::enter(const Node& node) {
  for (; fixed_.size() > node.depth; fixed_.pop_back()) {
    model_.setBounds(fixed_.back(), 0, std::numeric_limits<double>::infinity());
  }
  if (node.variable < 0) return;
  model_.setBounds(node.variable, node.value, node.value);
  fixed_.push_back(node.variable);
}

ArcFlowSearch::Verdict ArcFlowSearch::solveRelaxation() {
  while (!stopped()) {
    const LpStatus status = model_.solve(method_);
    method_ = Simplex::kDual;
    ++counts_.linear_programs;
    counts_.columns = static_cast<std::uint64_t>(model_.columns());
    counts_.rows = static_cast<std::uint64_t>(model_.rows());
    counts_.expansions += counts_.columns;
    if (status == LpStatus::kInterrupted) {
      end_ = SearchEnd::kInterrupted;
      break;
    }
    if (status == LpStatus::kInfeasible) return Verdict::kPruned;
    const bool dear = roundUp(model_.objective()) >= static_cast<double>(cost_limit_);
    if (ruleOf(objective_).sums() && dear) return Verdict::kPruned;
    if (!separate()) return Verdict::kOpen;
  }
  return Verdict::kStopped;
}

bool ArcFlowSearch::separate() {
  std::vector<UsedPath> used;
  for (std::size_t j = 0; j < variables_.size(); ++j) {
    const double value = model_.primal(static_cast<int>(j));
    if (value < kIntegral) continue;
    used.push_back({variables_[j].robot, value, nullptr, &variables_[j].moves});
  }
  std::vector<ConflictRow> rows;
  separator_.find(used, rows);
  for (const ConflictRow& row : rows) {
    Coefficients coefficients;
    for (const ConflictRow::Term& term : row.terms) {
      const auto found = variables_of_.find(term.move);
      if (found == variables_of_.end()) continue;
      for (const int column : found->second) coefficients.add(column, 1);
    }
    model_.addRow(RowKind::kAtMost, row.upper, coefficients);
  }
  return !rows.empty();
}

int ArcFlowSearch::mostFractional() const {
  int best = -1;
  double most = kIntegral;
  for (int j = 0; j < model_.columns(); ++j) {
    const double doubt = std::min(model_.primal(j), 1 - model_.primal(j));
    if (doubt <= most) continue;
    most = doubt;
    best = j;
  }
  return best;
}

void ArcFlowSearch::accept() {
  Plan plan;
  plan.paths.resize(instance_.robots());
  std::vector<std::vector<std::pair<std::uint32_t, Vertex>>> visits(instance_.robots());
  for (std::size_t j = 0; j < variables_.size(); ++j) {
    const Variable& variable = variables_[j];
    if (variable.arrival || model_.primal(static_cast<int>(j)) < 0.5) continue;
    const MoveId move = variable.moves.front();
    visits[variable.robot].emplace_back(space_.stepOf(move) + 1, space_.toOf(move));
  }
  for (std::uint32_t i = 0; i < instance_.robots(); ++i) {
    std::sort(visits[i].begin(), visits[i].end());
    plan.paths[i].push_back(instance_.start(i));
    for (const auto& [step, vertex] : visits[i]) plan.paths[i].push_back(vertex);
  }
  if (!validate(instance_, plan).empty()) {
    throw GlpkError(GlpkError::Kind::kFailure, "an integral solution with conflicts in it");
  }
  trimToArrival(plan);
  if (costOf(plan, objective_) >= cost_limit_) return;
  cost_limit_ = costOf(plan, objective_);
  plan_ = std::move(plan);
}

}  // namespace split_mapf::ilp
