#pragma once

#include <memory>
#include <vector>

#include "split_mapf/split/splitter.h"
#include "split_mapf/split/splitter_registry.h"
#include "split_mapf/split/time_split.h"

namespace split_mapf {

class PieceSequence;

/// How a request cuts in time.
TimeSplitOptions timeOptionsOf(const SplitRequest& request, const Instance& instance,
                               std::uint64_t seed, const SolvabilityChecker* checker);

/// Cuts in time: see splitTime(). A piece that fails is cut anew together with its neighbour, with
/// other intermediate states; then the two become one piece with a double share; the last one left
/// is the whole, without a limit.
class TimeSplitter : public Splitter {
 public:
  /// @param ways  see splitTime(). @pre `instance` and the options' checker outlive this object.
  TimeSplitter(const Instance& instance, TimeSplitOptions options, std::vector<Path> ways = {});
  ~TimeSplitter() override;
  static SplitterInfo info();

  bool split(const Deadline& deadline) override;
  PieceTree tree() const override;
  bool cutAnew(PieceId piece, const std::unordered_set<PieceId>& failed,
               const Deadline& deadline) override;
  bool merge(PieceId piece, const Deadline& deadline) override;

 private:
  std::size_t indexOf(PieceId piece) const;

  const Instance& instance_;
  TimeSplitOptions options_;
  std::vector<Path> ways_;
  PieceId next_id_ = 0;
  std::unique_ptr<PieceSequence> sequence_;
};

}  // namespace split_mapf
