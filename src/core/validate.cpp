#include "split_mapf/core/validate.h"

#include <algorithm>
#include <utility>

#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

/// Paths made of vertices; a number that is no vertex of the grid is possible.
class VertexPaths {
 public:
  VertexPaths(const Grid& grid, const std::vector<Path>& paths) : grid_(grid), paths_(paths) {}
  std::uint32_t count() const { return static_cast<std::uint32_t>(paths_.size()); }
  std::uint32_t length(std::uint32_t path) const {
    return static_cast<std::uint32_t>(paths_[path].size());
  }
  /// kNoVertex for an entry that is no free cell.
  Vertex vertex(std::uint32_t path, std::uint32_t step) const {
    const Vertex v = paths_[path][step];
    return v < grid_.size() ? v : kNoVertex;
  }
  std::string name(std::uint32_t path, std::uint32_t step) const {
    const Vertex v = vertex(path, step);
    return v == kNoVertex ? "vertex " + std::to_string(paths_[path][step])
                          : toString(grid_.cellOf(v));
  }
  /// What is wrong with an entry that is no free cell.
  std::string defect(std::uint32_t /*path*/, std::uint32_t /*step*/) const {
    return "which the map of " + std::to_string(grid_.size()) + " free cells does not have";
  }
  /// Whether the entry can follow the one before it. A number that is no vertex has no place, so
  /// that moves from and to it cannot be judged.
  bool follows(std::uint32_t path, std::uint32_t step) const {
    const Vertex from = vertex(path, step - 1);
    const Vertex to = vertex(path, step);
    if (from == to || from == kNoVertex || to == kNoVertex) return true;
    return grid_.isStep(grid_.cellOf(from), grid_.cellOf(to));
  }

 private:
  const Grid& grid_;
  const std::vector<Path>& paths_;
};

/// Paths made of cells, wherever these are.
class ClaimedPaths {
 public:
  ClaimedPaths(const Grid& grid, const std::vector<std::vector<Cell>>& paths)
      : grid_(grid), paths_(paths) {}
  std::uint32_t count() const { return static_cast<std::uint32_t>(paths_.size()); }
  std::uint32_t length(std::uint32_t path) const {
    return static_cast<std::uint32_t>(paths_[path].size());
  }
  Vertex vertex(std::uint32_t path, std::uint32_t step) const {
    return grid_.vertexAt(paths_[path][step]);
  }
  std::string name(std::uint32_t path, std::uint32_t step) const {
    return toString(paths_[path][step]);
  }
  std::string defect(std::uint32_t path, std::uint32_t step) const {
    if (grid_.contains(paths_[path][step])) return "a blocked cell";
    return "outside the map of " + std::to_string(grid_.width()) + "x" +
           std::to_string(grid_.height()) + " cells";
  }
  bool follows(std::uint32_t path, std::uint32_t step) const {
    return grid_.isStep(paths_[path][step - 1], paths_[path][step]);
  }

 private:
  const Grid& grid_;
  const std::vector<std::vector<Cell>>& paths_;
};

std::string robotNamed(std::uint32_t robot) { return "robot " + std::to_string(robot); }

std::string robotsNamed(std::uint32_t robot, std::uint32_t other) {
  return "robots " + std::to_string(robot) + " and " + std::to_string(other);
}

/// What is wrong with single robots.
template <typename Paths>
class RobotChecks {
 public:
  RobotChecks(const Instance& instance, const Paths& paths, SparsePoll& poll,
              std::vector<Violation>& violations)
      : instance_(instance), paths_(paths), poll_(poll), violations_(violations) {}

  void run() {
    if (paths_.count() != instance_.robots()) {
      violations_.push_back({ViolationKind::kRobotCount, 0, 0, 0,
                             "the plan has " + counted(paths_.count(), "path") +
                                 ", but the instance has " + counted(instance_.robots(), "robot")});
    }
    for (std::uint32_t robot = 0; robot < paths_.count(); ++robot) check(robot);
  }

 private:
  void check(std::uint32_t robot) {
    if (paths_.length(robot) == 0) {
      add(ViolationKind::kEmptyPath, robot, 0, "its path is empty; it needs at least its start");
      return;
    }
    if (robot < instance_.robots()) checkStart(robot);
    for (std::uint32_t step = 0; step < paths_.length(robot); ++step) {
      poll_();
      checkEntry(robot, step);
    }
    if (robot < instance_.robots()) checkGoal(robot);
  }

  void checkStart(std::uint32_t robot) {
    if (paths_.vertex(robot, 0) == instance_.start(robot)) return;
    add(ViolationKind::kWrongStart, robot, 0,
        "its path begins at " + paths_.name(robot, 0) + " instead of its start " +
            toString(instance_.grid().cellOf(instance_.start(robot))));
  }

  void checkEntry(std::uint32_t robot, std::uint32_t step) {
    if (step > 0 && !paths_.follows(robot, step)) {
      add(ViolationKind::kJump, robot, step,
          "it jumps from " + paths_.name(robot, step - 1) + " to " + paths_.name(robot, step) +
              " in step " + std::to_string(step) +
              (instance_.grid().hasUnitMoves() ? "; a move leads to one of four neighbours"
                                               : "; a move leads along an edge of the graph"));
    }
    if (paths_.vertex(robot, step) == kNoVertex) {
      add(ViolationKind::kOutsideGrid, robot, step,
          "at step " + std::to_string(step) + " it is in " + paths_.name(robot, step) + ", " +
              paths_.defect(robot, step));
    }
  }

  void checkGoal(std::uint32_t robot) {
    const std::uint32_t last = paths_.length(robot) - 1;
    if (paths_.vertex(robot, last) == instance_.goal(robot)) return;
    add(ViolationKind::kWrongGoal, robot, last,
        "its path ends at " + paths_.name(robot, last) + " after step " + std::to_string(last) +
            " instead of at its goal " + toString(instance_.grid().cellOf(instance_.goal(robot))));
  }

  void add(ViolationKind kind, std::uint32_t robot, std::uint32_t step, const std::string& what) {
    violations_.push_back({kind, robot, robot, step, robotNamed(robot) + ": " + what});
  }

  const Instance& instance_;
  const Paths& paths_;
  SparsePoll& poll_;
  std::vector<Violation>& violations_;
};

/// Who stands where at one step: a list of robots a cell, in ascending order. A hash table of the
/// cells that are taken, whose entries of earlier steps are told by their stamp and count as free,
/// so that a step costs O(robots there) and memory is O(robots), whatever the grid's size.
class Occupancy {
 public:
  static constexpr std::uint32_t kNobody = 0xffffffffU;

  explicit Occupancy(std::uint32_t robots) : next_(robots, kNobody) {
    std::size_t size = 2;
    while (size < std::size_t{2} * robots) size *= 2;
    entries_.resize(size);
  }

  /// Nobody is anywhere at another step.
  void begin(std::uint32_t step) { step_ = step; }
  /// @pre begin() was called; lists ascend where robots come in descending order.
  void add(std::uint32_t robot, Vertex v) {
    Entry& entry = entries_[placeOf(v)];
    next_[robot] = entry.step == step_ ? entry.first : kNobody;
    entry = {step_, v, robot};
  }
  /// @pre begin() was called.
  std::uint32_t firstIn(Vertex v) const {
    const Entry& entry = entries_[placeOf(v)];
    return entry.step == step_ ? entry.first : kNobody;
  }
  std::uint32_t nextAfter(std::uint32_t robot) const { return next_[robot]; }

 private:
  struct Entry {
    std::uint32_t step = 0xffffffffU;
    Vertex cell = kNoVertex;
    std::uint32_t first = kNobody;  // lowest-numbered robot there
  };
  /// Where the cell's entry of this step is, or would be.
  std::size_t placeOf(Vertex v) const {
    const std::size_t mask = entries_.size() - 1;
    std::size_t place = (v * 0x9e3779b1U >> 8U) & mask;
    while (entries_[place].step == step_ && entries_[place].cell != v) place = (place + 1) & mask;
    return place;
  }

  std::uint32_t step_ = 0;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> next_;  // robot -> next higher-numbered robot in its cell
};

/// What is wrong between two robots. Robots whose paths have ended cost nothing from then on: steps
/// are told first whether anything is wrong in them, and looked at in full where something is.
template <typename Paths>
class PairChecks {
 public:
  PairChecks(const Grid& grid, const Paths& paths, SparsePoll& poll,
             std::vector<Violation>& violations)
      : grid_(grid),
        paths_(paths),
        poll_(poll),
        violations_(violations),
        under_way_(paths.count()),
        before_(paths.count(), kNoVertex),
        now_(paths.count(), kNoVertex),
        occupants_before_(paths.count()),
        occupants_(paths.count()),
        ended_(paths.count()) {
    for (std::uint32_t i = 0; i < paths.count(); ++i) under_way_[i] = paths.count() - 1 - i;
    ended_.begin(0);
  }

  void run() {
    for (std::uint32_t step = 0; !under_way_.empty(); ++step) {
      advance(step);
      const bool was_clean = is_clean_;
      is_clean_ = isClean();
      if (!is_clean_ || !was_clean) name(step);
    }
  }

 private:
  void advance(std::uint32_t step) {
    std::swap(before_, now_);
    std::swap(occupants_before_, occupants_);
    occupants_.begin(step);
    std::size_t left = 0;
    for (const std::uint32_t robot : under_way_) {
      poll_();
      if (step >= paths_.length(robot)) {
        end(robot);
        continue;
      }
      under_way_[left++] = robot;
      now_[robot] = paths_.vertex(robot, step);
      if (now_[robot] != kNoVertex) occupants_.add(robot, now_[robot]);
    }
    under_way_.resize(left);
  }

  void end(std::uint32_t robot) {
    now_[robot] = before_[robot];
    if (now_[robot] != kNoVertex) ended_.add(robot, now_[robot]);
  }

  /// Whether nobody who is under way meets anybody. @pre the step before was clean, else more may
  /// have been where somebody goes than one looks at.
  bool isClean() const {
    return std::none_of(under_way_.begin(), under_way_.end(), [this](std::uint32_t robot) {
      const Vertex v = now_[robot];
      if (v == kNoVertex) return false;
      if (occupants_.nextAfter(robot) != Occupancy::kNobody) return true;
      if (ended_.firstIn(v) != Occupancy::kNobody) return true;
      if (before_[robot] == kNoVertex || before_[robot] == v) return false;
      const std::uint32_t other = occupants_before_.firstIn(v);
      return other != Occupancy::kNobody && other != robot && now_[other] == before_[robot];
    });
  }

  /// All that is wrong in a step.
  void name(std::uint32_t step) {
    const Occupancy before = everybodyAt(before_);
    const Occupancy now = everybodyAt(now_);
    for (std::uint32_t robot = 0; robot < paths_.count(); ++robot) {
      poll_();
      if (now_[robot] == kNoVertex) continue;
      checkVertex(now, robot, step);
      if (step > 0) checkSwap(before, robot, step);
    }
  }

  Occupancy everybodyAt(const std::vector<Vertex>& positions) const {
    Occupancy occupants(paths_.count());
    occupants.begin(0);
    for (auto robot = paths_.count(); robot-- > 0;) {
      if (positions[robot] != kNoVertex) occupants.add(robot, positions[robot]);
    }
    return occupants;
  }

  void checkVertex(const Occupancy& occupants, std::uint32_t robot, std::uint32_t step) {
    const std::uint32_t other = occupants.firstIn(now_[robot]);
    if (other == robot || (ended(robot, step) && ended(other, step))) return;
    violations_.push_back({ViolationKind::kVertexConflict, other, robot, step,
                           robotsNamed(other, robot) + ": both in " +
                               toString(grid_.cellOf(now_[robot])) + " at step " +
                               std::to_string(step)});
  }

  /// Looks for a lower-numbered robot that came from where this one goes, and went where it was.
  void checkSwap(const Occupancy& occupants_before, std::uint32_t robot, std::uint32_t step) {
    if (before_[robot] == kNoVertex || before_[robot] == now_[robot]) return;
    std::uint32_t other = occupants_before.firstIn(now_[robot]);
    while (other < robot && now_[other] != before_[robot])
      other = occupants_before.nextAfter(other);
    if (other >= robot) return;
    violations_.push_back({ViolationKind::kSwapConflict, other, robot, step,
                           robotsNamed(other, robot) + ": exchange the cells " +
                               toString(grid_.cellOf(before_[other])) + " and " +
                               toString(grid_.cellOf(now_[other])) + " in step " +
                               std::to_string(step)});
  }

  bool ended(std::uint32_t robot, std::uint32_t step) const { return step >= paths_.length(robot); }

  const Grid& grid_;
  const Paths& paths_;
  SparsePoll& poll_;
  std::vector<Violation>& violations_;
  std::vector<std::uint32_t> under_way_;  // robots whose paths have not ended, in descending order
  std::vector<Vertex> before_;            // robot -> position at the step before
  std::vector<Vertex> now_;
  Occupancy occupants_before_;  // of those under way
  Occupancy occupants_;
  Occupancy ended_;  // where paths have ended
  bool is_clean_ = true;
};

template <typename Paths>
std::vector<Violation> checkAll(const Instance& instance, const Paths& paths,
                                const Deadline& deadline) {
  std::vector<Violation> violations;
  SparsePoll poll(deadline);
  RobotChecks<Paths>(instance, paths, poll, violations).run();
  PairChecks<Paths>(instance.grid(), paths, poll, violations).run();
  return violations;
}

}  // namespace

std::vector<Violation> validate(const Instance& instance, const Plan& plan,
                                const Deadline& deadline) {
  return checkAll(instance, VertexPaths(instance.grid(), plan.paths), deadline);
}

std::vector<Violation> validate(const Instance& instance,
                                const std::vector<std::vector<Cell>>& paths) {
  return checkAll(instance, ClaimedPaths(instance.grid(), paths), Deadline());
}

}  // namespace split_mapf
