#pragma once

#include <functional>
#include <memory>
#include <string>
#include <unordered_set>

#include "plugin/watched_call.h"
#include "split_mapf/split/splitter_registry.h"

namespace split_mapf {

/// A splitter of a plug-in, of which nothing is believed that can be checked. Where it throws, does
/// not stop at its deadline or makes no pieces that can be solved, SplitterFailure is thrown.
class GuardedSplitter : public Splitter {
 public:
  using Make = decltype(SplitterInfo::make);

  /// @param called  as messages name it. @param watch  of all splitters of the plug-in.
  GuardedSplitter(std::string called, Make make, SplitRequest request,
                  const SplitQuestion& question, std::shared_ptr<CallWatch> watch);

  /// @throws SplitSpecError for a split that does not fit the instance; SplitterFailure, as all
  /// below.
  bool split(const Deadline& deadline) override;
  PieceTree tree() const override { return tree_; }
  bool cutAnew(PieceId piece, const std::unordered_set<PieceId>& failed,
               const Deadline& deadline) override;
  bool merge(PieceId piece, const Deadline& deadline) override;

 private:
  struct Work;
  /// Takes the tree as it is then. @param must  whether false is an answer only at the deadline.
  bool ask(std::function<bool(Work&)> question, const Deadline& deadline, bool must);
  [[noreturn]] void fail(const std::string& why) const;

  const std::string called_;
  const std::shared_ptr<Work> work_;
  const std::shared_ptr<CallWatch> watch_;
  PieceTree tree_;
};

}  // namespace split_mapf
