#pragma once

#include <cstdint>
#include <memory>
#include <unordered_set>
#include <vector>

#include "split_mapf/split/space_split.h"
#include "split_mapf/split/splitter.h"
#include "split_mapf/split/splitter_registry.h"

namespace split_mapf {

/// Cuts in space (see SpaceSplit) and, where wanted, each region's piece in time. A region that is
/// cut in time repairs itself as TimeSplitter does until it is one piece. If that fails, its robots
/// get other intermediate states; then it is merged with its neighbour for that phase, up to the
/// whole graph; then two phases become one; in the end there is one piece, the whole instance,
/// without a limit.
class SpaceSplitter : public Splitter {
 public:
  struct Options {
    SpaceSplitOptions space;
    TimeSplitOptions time;    ///< how to cut each region's piece in time; its checker is not used
    bool check_seams = true;  ///< whether seams of crowded pieces are checked for solvability
  };
  /// @pre as SpaceSplit. @throws SplitSpecError when the regions do not fit the grid.
  SpaceSplitter(const Instance& instance, Options options);
  ~SpaceSplitter() override;
  static SplitterInfo info();

  bool split(const Deadline& deadline) override;
  PieceTree tree() const override;
  bool cutAnew(PieceId piece, const std::unordered_set<PieceId>& failed,
               const Deadline& deadline) override;
  bool merge(PieceId piece, const Deadline& deadline) override;
  std::optional<Layout> layout() const override { return split_.layout(); }

 private:
  struct Region;
  using Phase = std::vector<Region>;
  /// Where a piece lies.
  struct Place {
    std::uint32_t phase = 0;
    std::size_t region = 0;  ///< in the phase's list
    std::size_t piece = 0;   ///< in the region's sequence
  };

  Place find(PieceId piece) const;
  Region makeRegion(Piece piece, std::uint32_t shares, const Deadline& deadline, bool in_time);
  bool drawStatesAnew(const Place& place, const Deadline& deadline);
  bool mergeRegions(const Place& place, const Deadline& deadline);
  void joinPhases(std::uint32_t phase, std::uint32_t shares, const Deadline& deadline);

  SpaceSplit split_;
  TimeSplitOptions time_;
  bool check_seams_;
  PieceId next_id_ = 0;
  std::vector<Phase> phases_;
};

}  // namespace split_mapf
