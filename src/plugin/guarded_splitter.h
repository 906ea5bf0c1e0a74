#pragma once

#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
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
  /// @throws Interrupted when the deadline has expired already: then the splitter is not asked.
  bool ask(std::function<bool(Work&)> question, const Deadline& deadline);
  /// Asks for a tree without this piece.
  bool replace(PieceId piece, std::function<bool(Work&)> question, const Deadline& deadline);
  /// Takes the tree as it is now.
  void takeTree();
  [[noreturn]] void fail(const std::string& why) const;

  const std::string called_;
  const std::shared_ptr<Work> work_;
  const std::shared_ptr<CallWatch> watch_;
  PieceTree tree_;
  std::unordered_set<PieceId> replaced_;            ///< may never come back
  std::unordered_map<PieceId, PieceHandle> known_;  ///< all others of this tree and earlier ones
};

}  // namespace split_mapf
