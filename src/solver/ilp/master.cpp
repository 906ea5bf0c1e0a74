#include "solver/ilp/master.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <boost/functional/hash.hpp>

namespace split_mapf::ilp {
namespace {

constexpr double kUsed = 1e-7;
// Solves after which an idle row or column is dropped.
constexpr std::uint32_t kRowPatience = 12;
constexpr std::uint32_t kColumnPatience = 30;
// Rather a few too many than to price and to separate the same again and again.
constexpr std::size_t kFewest = 200;

std::size_t hashOf(std::uint32_t robot, const Path& path) {
  std::size_t hash = boost::hash_range(path.begin(), path.end());
  boost::hash_combine(hash, robot);
  return hash;
}

}  // namespace

Master::Master(const MoveSpace& space, const std::vector<double>& artificial_costs,
               const Deadline& deadline, std::size_t memory_mb)
    : space_(space),
      robots_(static_cast<int>(artificial_costs.size())),
      model_(deadline, memory_mb) {
  Coefficients one;
  for (int i = 0; i < robots_; ++i) model_.addRow(RowKind::kAtLeast, 1, {});
  for (int i = 0; i < robots_; ++i) {
    one.clear();
    one.add(i, 1);
    model_.addColumn(artificial_costs[static_cast<std::size_t>(i)], one);
  }
}

std::vector<MoveId> Master::movesOf(const Path& path) const {
  std::vector<MoveId> moves(space_.horizon());
  for (std::uint32_t t = 0; t < space_.horizon(); ++t) {
    moves[t] = space_.move(t, positionAt(path, t), positionAt(path, t + 1));
  }
  return moves;
}

bool Master::addColumn(std::uint32_t robot, const Path& path, double cost) {
  const std::size_t hash = hashOf(robot, path);
  if (known_.count(hash) > 0) return false;
  Column column;
  column.robot = robot;
  column.cost = cost;
  column.hash = hash;
  column.path = path;
  column.moves = movesOf(path);
  std::vector<std::uint32_t> met;
  for (const MoveId move : column.moves) {
    const auto found = rows_of_.find(move);
    if (found == rows_of_.end()) continue;
    for (const Membership& member : found->second) {
      if (member.robot == kEverybody || member.robot == robot) met.push_back(member.row);
    }
  }
  std::sort(met.begin(), met.end());
  Coefficients coefficients;
  coefficients.add(static_cast<int>(robot), 1);
  for (std::size_t i = 0; i < met.size();) {
    std::size_t end = i + 1;
    while (end < met.size() && met[end] == met[i]) ++end;
    coefficients.add(firstRow() + static_cast<int>(met[i]), static_cast<double>(end - i));
    i = end;
  }
  model_.addColumn(cost, coefficients);
  known_.insert(hash);
  columns_.push_back(std::move(column));
  dual_feasible_ = false;
  return true;
}

void Master::indexRow(std::uint32_t row) {
  for (const ConflictRow::Term& term : rows_[row].row.terms) {
    rows_of_[term.move].push_back({row, term.robot});
  }
}

void Master::addRow(ConflictRow row) {
  Coefficients coefficients;
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    const Column& column = columns_[j];
    int count = 0;
    for (const ConflictRow::Term& term : row.terms) {
      if (term.robot != kEverybody && term.robot != column.robot) continue;
      if (column.moves[space_.stepOf(term.move)] == term.move) ++count;
    }
    if (count > 0) coefficients.add(firstColumn() + static_cast<int>(j), count);
  }
  model_.addRow(RowKind::kAtMost, row.upper, coefficients);
  rows_.push_back({std::move(row), 0});
  indexRow(static_cast<std::uint32_t>(rows_.size()) - 1);
}

void Master::allowOnly(const std::vector<RobotRules>& rules,
                       const std::vector<double>& most_costs) {
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    Column& column = columns_[j];
    const bool allowed = column.cost <= most_costs[column.robot] &&
                         rules[column.robot].allow(column.path, space_.horizon());
    if (allowed == column.allowed) continue;
    column.allowed = allowed;
    model_.setBounds(firstColumn() + static_cast<int>(j), 0,
                     allowed ? std::numeric_limits<double>::infinity() : 0);
  }
}

LpStatus Master::solve() {
  const LpStatus status = model_.solve(dual_feasible_ ? Simplex::kDual : Simplex::kPrimal);
  dual_feasible_ = true;
  if (status == LpStatus::kOptimal) age();
  return status;
}

std::optional<double> Master::probe(const Decision& decision, const Instance& instance) {
  std::vector<int> forbidden;
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    const Column& column = columns_[j];
    if (!column.allowed || obeys(column.robot, column.path, decision, instance)) continue;
    forbidden.push_back(firstColumn() + static_cast<int>(j));
    model_.setBounds(forbidden.back(), 0, 0);
  }
  if (model_.solve(Simplex::kDual) == LpStatus::kInterrupted) return std::nullopt;
  const double objective = model_.objective();
  for (const int column : forbidden) {
    model_.setBounds(column, 0, std::numeric_limits<double>::infinity());
  }
  return objective;
}

void Master::age() {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    rows_[i].idle = model_.isBasicRow(firstRow() + static_cast<int>(i)) ? rows_[i].idle + 1 : 0;
  }
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    Column& column = columns_[j];
    column.idle = model_.isBasicColumn(firstColumn() + static_cast<int>(j)) ? 0 : column.idle + 1;
  }
}

double Master::artificialUse() const {
  double sum = 0;
  for (int i = 0; i < robots_; ++i) sum += model_.primal(i);
  return sum;
}

std::vector<UsedPath> Master::usedPaths() const {
  std::vector<UsedPath> used;
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    const double value = model_.primal(firstColumn() + static_cast<int>(j));
    if (value < kUsed) continue;
    used.push_back({columns_[j].robot, value, &columns_[j].path, &columns_[j].moves});
  }
  std::stable_sort(used.begin(), used.end(),
                   [](const UsedPath& a, const UsedPath& b) { return a.robot < b.robot; });
  return used;
}

double Master::writePenalties(Penalties& penalties) const {
  penalties.clear();
  double loss = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double penalty = -model_.dual(firstRow() + static_cast<int>(i));
    if (penalty <= 0) continue;
    const ConflictRow& row = rows_[i].row;
    loss += penalty * row.upper;
    for (const ConflictRow::Term& term : row.terms) {
      if (term.robot == kEverybody) {
        penalties.add(term.move, penalty);
      } else {
        penalties.addFor(term.robot, term.move, penalty);
      }
    }
  }
  return loss;
}

void Master::purge(double hopeless) {
  purgeRows();
  purgeColumns(hopeless);
}

void Master::purgeRows() {
  std::vector<int> gone;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (rows_[i].idle > kRowPatience) {
      gone.push_back(firstRow() + static_cast<int>(i));
      continue;
    }
    if (kept != i) rows_[kept] = std::move(rows_[i]);
    ++kept;
  }
  if (gone.empty()) return;
  rows_.resize(kept);
  model_.deleteRows(gone);
  rows_of_.clear();
  for (std::uint32_t i = 0; i < rows_.size(); ++i) indexRow(i);
}

void Master::purgeColumns(double hopeless) {
  if (columns_.size() < kFewest) return;
  std::vector<int> gone;
  std::size_t kept = 0;
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    const int place = firstColumn() + static_cast<int>(j);
    const bool drop = columns_[j].idle > kColumnPatience ||
                      (columns_[j].idle > 0 && model_.reducedCost(place) > hopeless);
    if (drop) {
      gone.push_back(place);
      continue;
    }
    if (kept != j) columns_[kept] = std::move(columns_[j]);
    ++kept;
  }
  if (gone.empty()) return;
  columns_.resize(kept);
  model_.deleteColumns(gone);
  known_.clear();
  for (const Column& column : columns_) known_.insert(column.hash);
}

std::size_t Master::memoryBytes() const {
  const std::size_t column = sizeof(Column) + space_.horizon() * (sizeof(MoveId) + sizeof(Vertex));
  return model_.memoryBytes() + columns_.size() * column;
}

}  // namespace split_mapf::ilp
