#include "split_mapf/split/space_splitter.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "split/piece_sequence.h"
#include "split_mapf/split/time_splitter.h"

namespace split_mapf {
namespace {

// Seams of a piece are checked where its robots fill more than this share of its cells.
constexpr std::uint32_t kCrowdedCellsARobot = 4;

bool intersects(const std::vector<std::uint32_t>& sorted, const std::vector<std::uint32_t>& other) {
  return std::any_of(other.begin(), other.end(), [&](std::uint32_t robot) {
    return std::binary_search(sorted.begin(), sorted.end(), robot);
  });
}

/// A piece that was cut out of a region's, where its robots are numbered within the region.
Piece within(const Piece& region, Piece part) {
  for (std::uint32_t& robot : part.robots) robot = region.robots[robot];
  part.map = region.map;
  part.phase = region.phase;
  part.region = region.region;
  return part;
}

}  // namespace

/// A region of a phase with its piece, cut in time or not.
struct SpaceSplitter::Region {
  std::uint32_t region;
  std::vector<std::uint32_t> robots;  // ascending
  PieceSequence sequence;
  std::uint32_t shares;     // of the usual budget, for the piece as one
  bool drawn_anew = false;  // its states were drawn a second time
};

namespace {

SpaceSplitOptions spaceOptionsOf(const SplitRequest& request, std::uint64_t seed) {
  SpaceSplitOptions options = request.options.space;
  options.rows = request.spec.space->rows;
  options.columns = request.spec.space->columns;
  options.assignment = request.options.assignment.value_or(StateAssignment::kMatching);
  options.check = request.options.check != SplitOptions::Check::kNever;
  options.seed = seed;
  return options;
}

}  // namespace

SplitterInfo SpaceSplitter::info() {
  SplitterInfo info;
  info.name = "space";
  info.description = "Ns, RxCs, also with Kt behind: regions of the map, each cut in time";
  info.options = spaceSplitOptions();
  info.makes = [](const SplitSpec& spec) { return spec.space.has_value(); };
  // Bisection is a way to cut in time.
  info.check = TimeSplitter::info().check;
  info.make = [](const SplitRequest& request, SplitQuestion question) {
    const bool check = request.options.check != SplitOptions::Check::kNever;
    return std::make_unique<SpaceSplitter>(
        question.instance,
        Options{spaceOptionsOf(request, question.seed),
                timeOptionsOf(request, question.instance, question.seed, &question.checker),
                check});
  };
  info.rescues = true;
  info.cuts_map = true;
  return info;
}

SpaceSplitter::SpaceSplitter(const Instance& instance, Options options)
    : split_(instance, options.space),
      time_(std::move(options.time)),
      check_seams_(options.check_seams) {
  time_.checker = nullptr;
}

SpaceSplitter::~SpaceSplitter() = default;

bool SpaceSplitter::split(const Deadline& deadline) {
  if (!split_.plan(deadline)) return false;
  phases_.resize(split_.layout().phases.size());
  for (std::uint32_t phase = 0; phase < phases_.size(); ++phase) {
    for (Piece& piece : split_.piecesOf(phase)) {
      if (deadline.expired()) return false;
      phases_[phase].push_back(makeRegion(std::move(piece), 1, deadline, true));
    }
  }
  return true;
}

PieceTree SpaceSplitter::tree() const {
  std::vector<PieceTree> phases;
  for (const Phase& phase : phases_) {
    std::vector<PieceTree> regions;
    for (const Region& region : phase) {
      regions.push_back(PieceTree::sequence(region.sequence.pieces()));
    }
    phases.push_back(PieceTree::parallel(std::move(regions)));
  }
  return PieceTree::sequence(std::move(phases));
}

SpaceSplitter::Place SpaceSplitter::find(PieceId piece) const {
  Place place;
  for (place.phase = 0; place.phase < phases_.size(); ++place.phase) {
    const Phase& phase = phases_[place.phase];
    for (place.region = 0; place.region < phase.size(); ++place.region) {
      const std::vector<PieceHandle>& pieces = phase[place.region].sequence.pieces();
      for (place.piece = 0; place.piece < pieces.size(); ++place.piece) {
        if (pieces[place.piece]->id == piece) return place;
      }
    }
  }
  throw std::logic_error("a space split has no piece " + std::to_string(piece));
}

SpaceSplitter::Region SpaceSplitter::makeRegion(Piece piece, std::uint32_t shares,
                                                const Deadline& deadline, bool in_time) {
  std::vector<Piece> pieces;
  if (in_time && time_.ratios.size() > 1) {
    TimeSplitOptions cut = time_;
    std::optional<SolvabilityChecker> checker;
    const Graph& graph = piece.instance->graph();
    if (check_seams_ && piece.robots.size() > graph.size() / kCrowdedCellsARobot) {
      cut.checker = &checker.emplace(graph);
    }
    if (auto parts = splitTime(*piece.instance, cut, deadline)) {
      for (Piece& part : *parts) pieces.push_back(within(piece, std::move(part)));
    }
  }
  if (pieces.empty()) pieces.push_back(piece);
  return {piece.region, std::move(piece.robots),
          PieceSequence(std::move(pieces), {time_, shares, false}, next_id_), shares};
}

bool SpaceSplitter::cutAnew(PieceId piece, const std::unordered_set<PieceId>& failed,
                            const Deadline& deadline) {
  const Place place = find(piece);
  PieceSequence& sequence = phases_[place.phase][place.region].sequence;
  return sequence.isOnePiece() ? drawStatesAnew(place, deadline)
                               : sequence.cutAnew(place.piece, failed, deadline);
}

bool SpaceSplitter::drawStatesAnew(const Place& place, const Deadline& deadline) {
  Region& region = phases_[place.phase][place.region];
  if (region.drawn_anew) return false;
  region.drawn_anew = true;
  if (!split_.rematch(place.phase, region.region, deadline)) return false;
  region = makeRegion(split_.pieceOf(place.phase, region.region), region.shares, deadline, true);
  region.drawn_anew = true;
  for (Region& next : phases_[place.phase + 1]) {
    if (!intersects(region.robots, next.robots)) continue;
    const bool drawn_anew = next.drawn_anew;
    next = makeRegion(split_.pieceOf(place.phase + 1, next.region), next.shares, deadline, true);
    next.drawn_anew = drawn_anew;
  }
  return true;
}

bool SpaceSplitter::merge(PieceId piece, const Deadline& deadline) {
  const Place place = find(piece);
  Region& region = phases_[place.phase][place.region];
  if (region.sequence.merge(place.piece) || mergeRegions(place, deadline)) return true;
  if (phases_.size() > 1) {
    joinPhases(place.phase, 2 * region.shares, deadline);
    return true;
  }
  if (region.shares == 0) return false;
  region = makeRegion(split_.pieceOf(place.phase, region.region), 0, deadline, false);
  region.drawn_anew = true;
  return true;
}

bool SpaceSplitter::mergeRegions(const Place& place, const Deadline& deadline) {
  Phase& regions = phases_[place.phase];
  const std::uint32_t gone = regions[place.region].region;
  const std::optional<std::uint32_t> merged = split_.mergeRegion(place.phase, gone);
  if (!merged) return false;
  const auto merges = [&](const Region& region) {
    return region.region == gone || region.region == *merged;
  };
  std::uint32_t shares = 0;
  for (const Region& region : regions) {
    if (merges(region)) shares = std::max(shares, region.shares);
  }
  regions.erase(std::remove_if(regions.begin(), regions.end(), merges), regions.end());
  regions.push_back(makeRegion(split_.pieceOf(place.phase, *merged), shares, deadline, true));
  regions.back().drawn_anew = true;
  return true;
}

void SpaceSplitter::joinPhases(std::uint32_t phase, std::uint32_t shares,
                               const Deadline& deadline) {
  const std::uint32_t joint = split_.joinPhases(phase);
  phases_.erase(phases_.begin() + joint);
  phases_[joint].clear();
  for (Piece& piece : split_.piecesOf(joint)) {
    phases_[joint].push_back(makeRegion(std::move(piece), shares, deadline, true));
    phases_[joint].back().drawn_anew = true;
  }
  for (std::uint32_t later = joint + 1; later < phases_.size(); ++later) {
    for (Region& region : phases_[later]) region.sequence.setPhase(later);
  }
}

}  // namespace split_mapf
