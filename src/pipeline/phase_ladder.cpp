#include "pipeline/phase_ladder.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace split_mapf {
namespace {

// Seams of a piece are checked where its robots fill more than this share of its cells.
constexpr std::uint32_t kCrowdedCellsARobot = 4;

// A piece has little to do in its region, and where it takes more than this others help.
constexpr std::uint64_t kLeastEffort = 60000;

bool intersects(const std::vector<std::uint32_t>& sorted, const std::vector<std::uint32_t>& other) {
  return std::any_of(other.begin(), other.end(), [&](std::uint32_t robot) {
    return std::binary_search(sorted.begin(), sorted.end(), robot);
  });
}

}  // namespace

PhaseLadder::PhaseLadder(SpaceSplit& split, PieceSolver& solver, RunLog& log, Options options,
                         const Deadline& deadline)
    : split_(split),
      solver_(solver),
      log_(log),
      time_(std::move(options.time)),
      check_seams_(options.check_seams),
      deadline_(deadline) {
  if (options.rescue) rescuers_ = solver.rescuers();
  time_.checker = nullptr;
}

LadderOutcome PhaseLadder::climb(std::vector<SubproblemReport>& rows) {
  LadderOutcome outcome;
  build();
  while (solveOpenPieces(rows, outcome)) {
    const bool done = std::all_of(phases_.begin(), phases_.end(), [](const Phase& phase) {
      return std::all_of(phase.begin(), phase.end(), [](const Piece& piece) {
        return piece.sequence.state() == PieceSequence::State::kSolved;
      });
    });
    if (done) return finish(std::move(outcome));
    if (!repair(outcome)) break;
  }
  return outcome;
}

void PhaseLadder::build() {
  const auto phases = static_cast<std::uint32_t>(split_.layout().phases.size());
  phases_.resize(phases);
  for (std::uint32_t phase = 0; phase < phases; ++phase) {
    for (RegionPiece& region : split_.piecesOf(phase)) {
      if (deadline_.expired()) return;  // what is solved of it ends at once
      phases_[phase].push_back(makePiece(std::move(region), 1));
    }
  }
}

PhaseLadder::Piece PhaseLadder::makePiece(RegionPiece region, std::uint32_t shares, bool in_time) {
  std::vector<std::uint32_t> everyone(region.robots.size());
  std::iota(everyone.begin(), everyone.end(), 0U);
  std::optional<Decomposition> tree;
  if (in_time && time_.ratios.size() > 1) {
    TimeSplitOptions cut = time_;
    std::optional<SolvabilityChecker> checker;
    const Graph& graph = region.instance->graph();
    if (check_seams_ && region.robots.size() > graph.size() / kCrowdedCellsARobot) {
      cut.checker = &checker.emplace(graph);
    }
    tree = splitTime(*region.instance, cut, deadline_);
  }
  if (!tree) tree = Decomposition::leaf(*region.instance, std::move(everyone));
  PieceSequence::Options options;
  options.time = time_;
  options.last_share = shares;
  if (in_time) options.rescuers = rescuers_;
  PieceSequence sequence(
      embed(std::move(*tree), region.robots, region.map, region.phase, region.region),
      std::move(options));
  return {std::move(region), std::move(sequence), shares};
}

bool PhaseLadder::solveOpenPieces(std::vector<SubproblemReport>& rows, LadderOutcome& outcome) {
  std::vector<PieceTask> tasks;
  std::vector<PieceSequence*> open;
  for (Phase& phase : phases_) {
    for (Piece& piece : phase) {
      if (piece.sequence.state() != PieceSequence::State::kOpen) continue;
      const std::size_t first = tasks.size();
      piece.sequence.addOpenTasks(tasks);
      for (std::size_t i = first; i < tasks.size(); ++i) {
        if (piece.rescuer > 0) {
          tasks[i].solver = rescuers_[piece.rescuer - 1];
        } else if (tasks[i].solver.empty() && !rescuers_.empty()) {
          tasks[i].least_effort = kLeastEffort;
        }
      }
      open.push_back(&piece.sequence);
    }
  }
  log_.expectPieces(static_cast<std::uint32_t>(tasks.size()));
  std::vector<SolveResult> results = solver_.solve(tasks, rows);
  std::optional<SolveResult> end;
  std::size_t next = 0;
  for (PieceSequence* sequence : open) {
    std::optional<SolveResult> stop = sequence->take(results, next);
    if (!stop) continue;
    if (!end || end->termination == Termination::kCancelled) end = std::move(stop);
  }
  if (end) outcome.last = std::move(*end);
  return !end && !deadline_.expired();
}

bool PhaseLadder::repair(LadderOutcome& outcome) {
  for (Phase& phase : phases_) {
    for (Piece& piece : phase) {
      if (piece.sequence.state() == PieceSequence::State::kOpen) piece.sequence.repair(deadline_);
    }
  }
  for (std::uint32_t phase = 0; phase < phases_.size(); ++phase) {
    for (std::size_t i = 0; phase < phases_.size() && i < phases_[phase].size();) {
      if (phases_[phase][i].sequence.state() != PieceSequence::State::kStuck) {
        ++i;
        continue;
      }
      if (!repairStuck(phase, i, outcome)) return false;
      i = 0;  // pieces have moved
    }
  }
  return true;
}

bool PhaseLadder::repairStuck(std::uint32_t phase, std::size_t index, LadderOutcome& outcome) {
  if (rematch(phase, index)) return true;
  if (!phases_[phase][index].merged && mergeRegions(phase, index)) return true;
  if (askRescuer(phases_[phase][index]) || mergeRegions(phase, index)) return true;
  Piece& piece = phases_[phase][index];
  if (phases_.size() > 1) {
    joinPhases(phase, 2 * piece.shares);
    return true;
  }
  outcome.last = piece.sequence.lastResult();
  if (piece.shares == 0) return false;
  Piece whole = makePiece(std::move(piece.region), 0, false);
  whole.rematched = whole.merged = true;
  whole.rescuer = 0;
  piece = std::move(whole);
  return true;
}

bool PhaseLadder::rematch(std::uint32_t phase, std::size_t index) {
  Piece& piece = phases_[phase][index];
  if (piece.rematched) return false;
  piece.rematched = true;
  const std::uint32_t region = piece.region.region;
  if (!split_.rematch(phase, region, deadline_)) return false;
  piece = makePiece(split_.pieceOf(phase, region), piece.shares);
  piece.rematched = true;
  const std::vector<std::uint32_t> robots = piece.region.robots;
  for (Piece& next : phases_[phase + 1]) {
    if (!intersects(robots, next.region.robots)) continue;
    const bool rematched = next.rematched;
    next = makePiece(split_.pieceOf(phase + 1, next.region.region), next.shares);
    next.rematched = rematched;
  }
  return true;
}

bool PhaseLadder::askRescuer(Piece& piece) {
  const bool hopeless = piece.sequence.lastResult().termination == Termination::kUnsolvable;
  if (hopeless || piece.shares == 0 || piece.rescuer == rescuers_.size()) return false;
  const std::size_t rescuer = piece.rescuer + 1;
  Piece again = makePiece(std::move(piece.region), piece.shares, false);
  again.rematched = again.merged = true;
  again.rescuer = rescuer;
  piece = std::move(again);
  return true;
}

bool PhaseLadder::mergeRegions(std::uint32_t phase, std::size_t index) {
  Phase& pieces = phases_[phase];
  const std::uint32_t gone = pieces[index].region.region;
  std::uint32_t shares = pieces[index].shares;
  const std::optional<std::uint32_t> region = split_.mergeRegion(phase, gone);
  if (!region) return false;
  const auto merges = [&](const Piece& piece) {
    return piece.region.region == gone || piece.region.region == *region;
  };
  for (const Piece& piece : pieces) {
    if (merges(piece)) shares = std::max(shares, piece.shares);
  }
  pieces.erase(std::remove_if(pieces.begin(), pieces.end(), merges), pieces.end());
  pieces.push_back(makePiece(split_.pieceOf(phase, *region), shares));
  pieces.back().rematched = pieces.back().merged = true;
  return true;
}

void PhaseLadder::joinPhases(std::uint32_t phase, std::uint32_t shares) {
  const std::uint32_t joint = split_.joinPhases(phase);
  phases_.erase(phases_.begin() + joint);
  phases_[joint].clear();
  for (RegionPiece& region : split_.piecesOf(joint)) {
    phases_[joint].push_back(makePiece(std::move(region), shares));
    phases_[joint].back().rematched = phases_[joint].back().merged = true;
  }
  // The phases behind have a new number.
  for (std::uint32_t later = joint + 1; later < phases_.size(); ++later) {
    for (Piece& piece : phases_[later]) piece.region.phase = later;
  }
}

LadderOutcome PhaseLadder::finish(LadderOutcome outcome) {
  outcome.last = {};  // what pieces proved holds within their regions
  std::vector<Decomposition> phases;
  for (Phase& phase : phases_) {
    std::vector<Decomposition> regions;
    for (Piece& piece : phase) regions.push_back(piece.sequence.takePieces(outcome.plans));
    phases.push_back(Decomposition::parallel(std::move(regions)));
  }
  outcome.pieces = Decomposition::sequence(std::move(phases));
  return outcome;
}

}  // namespace split_mapf
