#include "split_mapf/split/space_split.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "split/space_drawer.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

using RobotsByRegion = std::map<std::uint32_t, std::vector<std::uint32_t>>;

RobotsByRegion groupByRegion(const Ownership& ownership, const std::vector<Vertex>& from) {
  RobotsByRegion groups;
  for (std::uint32_t robot = 0; robot < from.size(); ++robot) {
    groups[ownership[from[robot]]].push_back(robot);
  }
  return groups;
}

Partition makePartition(const Instance& instance, const SpaceSplitOptions& options) {
  const std::uint64_t regions = std::uint64_t{options.rows} * options.columns;
  if (regions > instance.graph().size()) {
    throw SplitSpecError("a space split into " + std::to_string(regions) +
                         " regions does not fit a map of " +
                         counted(instance.graph().size(), "free cell"));
  }
  if (options.partition == PartitionKind::kRectangles && !instance.grid().hasUnitMoves()) {
    throw SplitSpecError(
        "split option partition=rectangles needs moves between neighbouring cells; robots that "
        "have "
        "size move on a planning graph: take partition=dynamic");
  }
  const bool fits =
      options.rows <= instance.grid().height() && options.columns <= instance.grid().width();
  const bool rectangles =
      options.partition == PartitionKind::kRectangles ||
      (options.partition == PartitionKind::kAuto && fits &&
       suitsRectangles(instance.grid(), options.rows, options.columns, options.buffer));
  return rectangles
             ? partitionRectangles(instance.grid(), options.rows, options.columns, options.buffer)
             : partitionDynamic(instance, static_cast<std::uint32_t>(regions), options.buffer);
}

/// Notices when phases bring nobody closer.
class Progress {
 public:
  /// Whether one of the last few phases has brought the robots closer to their goals than ever.
  bool goesOn(std::uint64_t distance, std::uint64_t phases) {
    constexpr std::uint32_t kPatience = 2;
    const bool better = distance < least_distance_ || phases < least_phases_;
    least_distance_ = std::min(least_distance_, distance);
    least_phases_ = std::min(least_phases_, phases);
    idle_ = better ? 0 : idle_ + 1;
    return idle_ <= kPatience;
  }

 private:
  std::uint64_t least_distance_ = UINT64_MAX;
  std::uint64_t least_phases_ = UINT64_MAX;
  std::uint32_t idle_ = 0;
};

}  // namespace

SpaceSplit::SpaceSplit(const Instance& instance, const SpaceSplitOptions& options)
    : instance_(instance),
      options_(options),
      drawer_(std::make_unique<Drawer>(instance, options_, makePartition(instance, options_))) {
  layout_.partition = drawer_->partition().kind;
  layout_.ownerships.assign(drawer_->partition().ownerships.begin(),
                            drawer_->partition().ownerships.end());
}

SpaceSplit::~SpaceSplit() = default;

const std::vector<Vertex>& SpaceSplit::statesBefore(std::uint32_t phase) const {
  return phase == 0 ? instance_.starts() : layout_.phases[phase - 1].states;
}

bool SpaceSplit::plan(const Deadline& deadline) {
  // Phases that only wait for others are cut short: the whole graph takes everybody home.
  const std::uint32_t usual = drawer_->questionFor(instance_.starts(), 0).phases_left;
  const std::uint32_t most_phases = 2 * usual + options_.rows + options_.columns;
  Progress progress;
  while (layout_.phases.empty() || layout_.phases.back().states != instance_.goals()) {
    if (deadline.expired()) return false;
    const auto phase = static_cast<std::uint32_t>(layout_.phases.size());
    const std::vector<Vertex> from = statesBefore(phase);
    std::uint64_t distance = 0;
    std::uint64_t phases = 0;
    for (std::uint32_t robot = 0; robot < from.size(); ++robot) {
      distance += instance_.distances(robot)(from[robot]);
      phases += drawer_->states().phasesNeeded(robot, from[robot], phase % 2);
    }
    Layout::Phase next;
    next.ownership = phase % 2;
    next.states = from;
    layout_.phases.push_back(std::move(next));
    if (phase >= most_phases || !progress.goesOn(distance, phases)) {
      makeWhole(phase);
      layout_.phases[phase].states = instance_.goals();
    } else {
      drawPhase(phase, from, deadline);
    }
  }
  return !deadline.expired();
}

void SpaceSplit::drawPhase(std::uint32_t phase, const std::vector<Vertex>& from,
                           const Deadline& deadline) {
  RegionQuestion question = drawer_->questionFor(from, phase);
  std::vector<std::uint32_t> open;
  for (const auto& group : groupByRegion(ownershipOf(phase), from)) open.push_back(group.first);
  while (!open.empty() && !deadline.expired()) {
    question.region = open.back();
    open.pop_back();
    question.ownership = &ownershipOf(phase);
    question.robots = groupByRegion(*question.ownership, from)[question.region];
    if (question.robots.empty()) continue;  // merged away meanwhile
    std::vector<Vertex> to = drawer_->draw(question, layout_.phases[phase].ownership, deadline);
    if (to.empty() && !deadline.expired()) {
      if (const auto merged = mergeRegion(phase, question.region)) {
        open.push_back(*merged);
        continue;
      }
      // Moves can be undone: the goals can be reached from wherever the robots have got to.
      for (const std::uint32_t robot : question.robots) to.push_back(instance_.goal(robot));
    }
    for (std::size_t i = 0; i < to.size(); ++i) {
      layout_.phases[phase].states[question.robots[i]] = to[i];
    }
  }
}

Piece SpaceSplit::pieceOf(std::uint32_t phase, std::uint32_t region) const {
  const std::vector<Vertex>& from = statesBefore(phase);
  const std::vector<Vertex>& to = layout_.phases[phase].states;
  const Ownership& ownership = ownershipOf(phase);
  const RegionGrid& grid = drawer_->grids().of(layout_.phases[phase].ownership, ownership, region);
  Piece piece;
  piece.phase = phase;
  piece.region = region;
  piece.map = grid.map;
  Problem problem{grid.grid, {}, {}};
  DistanceTables::Standing tables;  // none of a bounded instance
  for (std::uint32_t robot = 0; robot < from.size(); ++robot) {
    if (ownership[from[robot]] != region) continue;
    piece.robots.push_back(robot);
    problem.starts.push_back(grid.localOf(from[robot]));
    problem.goals.push_back(grid.localOf(to[robot]));
    const bool is_same =
        !grid.map && to[robot] == instance_.goal(robot) && instance_.hasShareableDistances(robot);
    tables.push_back(is_same ? instance_.shareDistances(robot) : nullptr);
  }
  piece.instance =
      instance_.isBounded()
          ? std::make_shared<const Instance>(Instance::partOf(instance_, problem))
          : std::make_shared<const Instance>(std::move(problem), DistanceExtent::kOnDemand, tables);
  return piece;
}

std::vector<Piece> SpaceSplit::piecesOf(std::uint32_t phase) const {
  std::vector<Piece> pieces;
  for (const auto& group : groupByRegion(ownershipOf(phase), statesBefore(phase))) {
    pieces.push_back(pieceOf(phase, group.first));
  }
  return pieces;
}

bool SpaceSplit::rematch(std::uint32_t phase, std::uint32_t region, const Deadline& deadline) {
  if (phase + 1 >= layout_.phases.size()) return false;
  // After phases were joined the next one may belong to no partition, or to the same one.
  if (layout_.phases[phase + 1].ownership != 1 - phase % 2) return false;
  const std::vector<Vertex>& from = statesBefore(phase);
  RegionQuestion question = drawer_->questionFor(from, phase);
  question.ownership = &ownershipOf(phase);
  question.region = region;
  question.robots = groupByRegion(*question.ownership, from)[region];
  question.former = &layout_.phases[phase].states;
  question.attempt = 1;
  const std::vector<Vertex> to = drawer_->draw(question, layout_.phases[phase].ownership, deadline);
  for (std::size_t i = 0; i < to.size(); ++i) {
    layout_.phases[phase].states[question.robots[i]] = to[i];
  }
  return !to.empty();
}

std::optional<std::uint32_t> SpaceSplit::mergeRegion(std::uint32_t phase, std::uint32_t region) {
  const std::uint32_t neighbour = closestNeighbour(instance_.graph(), ownershipOf(phase), region);
  if (neighbour == kNoRegion) return std::nullopt;
  Ownership merged = ownershipOf(phase);
  std::replace(merged.begin(), merged.end(), region, neighbour);
  layout_.phases[phase].ownership = static_cast<std::uint32_t>(layout_.ownerships.size());
  layout_.ownerships.push_back(std::move(merged));
  return neighbour;
}

void SpaceSplit::makeWhole(std::uint32_t phase) {
  layout_.phases[phase].ownership = static_cast<std::uint32_t>(layout_.ownerships.size());
  layout_.ownerships.emplace_back(instance_.graph().size(), 0);
}

std::uint32_t SpaceSplit::joinPhases(std::uint32_t phase) {
  const auto last = static_cast<std::uint32_t>(layout_.phases.size()) - 1;
  const std::uint32_t first = phase == last ? phase - 1 : phase;
  layout_.phases.erase(layout_.phases.begin() + first);
  makeWhole(first);
  return first;
}

}  // namespace split_mapf
