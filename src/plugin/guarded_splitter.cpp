#include "plugin/guarded_splitter.h"

#include <exception>
#include <new>
#include <utility>

#include "plugin/own_instance.h"
#include "plugin/piece_tree_check.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/solver/solver.h"
#include "split_mapf/split/splitter_failure.h"

namespace split_mapf {

/// The splitter and all that it uses: a call that was given up keeps it.
struct GuardedSplitter::Work {
  Make make;
  SplitRequest request;
  Instance instance;
  SolvabilityChecker checker;
  std::uint64_t seed = 0;
  std::unique_ptr<Splitter> splitter;
  bool answer = false;
  PieceTree tree;
};

GuardedSplitter::GuardedSplitter(std::string called, Make make, SplitRequest request,
                                 const SplitQuestion& question, std::shared_ptr<CallWatch> watch)
    : called_(std::move(called)),
      work_(std::make_shared<Work>(Work{std::move(make), std::move(request),
                                        ownInstance(question.instance), question.checker,
                                        question.seed, nullptr, false, PieceTree()})),
      watch_(std::move(watch)) {}

bool GuardedSplitter::split(const Deadline& deadline) {
  const bool has_pieces = ask(
      [deadline](Work& work) {
        work.splitter =
            work.make(work.request, SplitQuestion{work.instance, work.checker, work.seed, {}});
        return work.splitter && work.splitter->split(deadline);
      },
      deadline);
  if (has_pieces) {
    takeTree();
  } else if (!deadline.expired()) {
    fail("made no pieces");
  }
  return has_pieces;
}

bool GuardedSplitter::cutAnew(PieceId piece, const std::unordered_set<PieceId>& failed,
                              const Deadline& deadline) {
  return replace(
      piece,
      [piece, failed, deadline](Work& work) {
        return work.splitter->cutAnew(piece, failed, deadline);
      },
      deadline);
}

bool GuardedSplitter::merge(PieceId piece, const Deadline& deadline) {
  return replace(
      piece, [piece, deadline](Work& work) { return work.splitter->merge(piece, deadline); },
      deadline);
}

bool GuardedSplitter::replace(PieceId piece, std::function<bool(Work&)> question,
                              const Deadline& deadline) {
  if (!ask(std::move(question), deadline)) return false;
  replaced_.insert(piece);
  known_.erase(piece);
  takeTree();
  return true;
}

bool GuardedSplitter::ask(std::function<bool(Work&)> question, const Deadline& deadline) {
  deadline.require();
  if (watch_->abandoned() > 0) {
    fail(
        "does not stop: a call of it that was given up still runs, and until it ends there is no "
        "other");
  }
  bool ended = false;
  try {
    ended = watch_->call(
        [work = work_, question = std::move(question)] {
          work->answer = question(*work);
          if (work->answer) work->tree = work->splitter->tree();
        },
        deadline);
  } catch (const SplitSpecError&) {
    throw;
  } catch (const Interrupted&) {
    if (deadline.expired()) throw;
    fail("threw Interrupted, but its deadline has not expired");
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    fail("threw: " + shown(error.what()));
  } catch (...) {
    fail("threw something that is no std::exception");
  }
  if (ended) return work_->answer;
  throw SplitterFailure(interruptionOf(deadline),
                        called_ + " did not stop at its deadline and was given up");
}

void GuardedSplitter::takeTree() {
  const std::string fault = findTreeFault(work_->tree, work_->instance);
  if (!fault.empty()) fail("made pieces that cannot be solved: " + fault);
  for (const PieceHandle& piece : piecesOf(work_->tree)) {
    const std::string name = "piece " + std::to_string(piece->id);
    // Whoever repairs would ask for the same again without end.
    if (replaced_.count(piece->id) > 0) {
      fail("says that it has replaced " + name + ", which is among its pieces");
    }
    // Plans are kept by the id, and one of other robots does not fit.
    const auto [known, is_new] = known_.emplace(piece->id, piece);
    if (!is_new && !isSamePiece(*known->second, *piece)) {
      fail("made pieces that cannot be told apart: " + name + " was another one before");
    }
  }
  tree_ = work_->tree;
}

void GuardedSplitter::fail(const std::string& why) const {
  throw SplitterFailure(Termination::kNoPlanFound, called_ + " " + why);
}

}  // namespace split_mapf
