#include "plugin/misbehaving_plugin.h"

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/solver/lacam.h"

namespace split_mapf::test {

std::atomic<bool> misbehaving_may_end{false};
std::atomic<bool> misbehaving_has_begun{false};

namespace {

std::vector<OptionInfo> options() { return {{"how", "none", "what is wrong with it"}}; }

std::string howOf(const std::map<std::string, std::string>& values) {
  const auto given = values.find("how");
  return given == values.end() ? "none" : given->second;
}

void hang() {
  misbehaving_has_begun = true;
  while (!misbehaving_may_end) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

class Misbehaving : public Solver {
 public:
  explicit Misbehaving(std::string how) : Solver("misbehaving", {}), how_(std::move(how)) {}

 private:
  SolveResult run(const SolveRequest& request) const override {
    SolveResult result = answer(request);
    if (how_ == "throw") throw std::runtime_error("no oil");
    if (how_ == "throw_int") throw 7;
    if (how_ == "hang") hang();
    if (how_ == "late") {
      misbehaving_has_begun = true;
      while (!request.deadline.expired()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      result.termination = Termination::kTimeout;
      result.plan.reset();
    }
    if (how_ == "collide") result.plan->paths[0] = result.plan->paths[1];
    if (how_ == "outside") result.plan->paths[0].assign(3, 4000000000U);
    if (how_ == "no_paths") result.plan->paths.clear();
    if (how_ == "no_plan") result.plan.reset();
    if (how_ == "bound") {
      result.lower_bound = 1000000;
      result.optimal = true;
      result.certified_by = "ecbs";
    }
    if (how_ == "unsolvable" || how_ == "timeout") {
      result.plan.reset();
      result.termination = how_ == "timeout" ? Termination::kTimeout : Termination::kUnsolvable;
    }
    return result;
  }

  static SolveResult answer(const SolveRequest& request) {
    return builtinSolvers().create("lacam", {})->solve(request.instance, Deadline(10));
  }

  const std::string how_;
};

class MisbehavingPieces : public WholeWhereItFails {
 public:
  MisbehavingPieces(const Instance& instance, std::string how)
      : WholeWhereItFails(instance), how_(std::move(how)) {}

  bool split(const Deadline& /*deadline*/) override {
    if (how_ == "throw") throw std::runtime_error("no knife");
    if (how_ == "hang") hang();
    if (how_ == "no_pieces") return false;
    Piece piece = *wholePiece(instance(), nextId());
    if (how_ == "robots") piece.robots[0] = 1000000;
    if (how_ == "twice") piece.robots[0] = piece.robots[1];
    if (how_ == "other_map") {
      const auto grid = std::make_shared<const Grid>(9, 9, std::vector<bool>(81, true));
      piece.instance = std::make_shared<const Instance>(
          Instance::fromVertices(grid, instance().starts(), instance().goals()));
    }
    if (how_ == "left_out") {
      piece.instance = std::make_shared<const Instance>(Instance::fromVertices(
          instance().sharedGrid(), {instance().start(0)}, {instance().goal(0)}));
      piece.robots = {0};
    }
    std::vector<PieceHandle> pieces = {std::make_shared<const Piece>(piece)};
    if (how_ == "null") pieces = {nullptr};
    if (how_ == "seam" || how_ == "reuse_id") {
      piece.id = nextId();
      pieces.push_back(std::make_shared<const Piece>(piece));
    }
    setTree(PieceTree::sequence(pieces));
    return true;
  }
  bool merge(PieceId /*piece*/, const Deadline& /*deadline*/) override {
    if (how_ == "reuse_id") {
      Piece piece = *wholePiece(instance(), 1);
      piece.instance = std::make_shared<const Instance>(
          Instance::fromVertices(instance().sharedGrid(), instance().goals(), instance().starts()));
      setTree(PieceTree::leaf(std::make_shared<const Piece>(piece)));
    }
    return how_ == "reuse_id" || how_ == "merge_nothing";
  }

 private:
  const std::string how_;
};

}  // namespace

MisbehavingSolver::MisbehavingSolver() {
  if (std::getenv(kThrowsWhenLoaded) != nullptr) throw 7;
}

SolverInfo MisbehavingSolver::info() const {
  SolverInfo info;
  info.name = "misbehaving";
  info.description = "does something wrong";
  info.traits.fallback_rank = 1;
  info.traits.complete = true;
  info.options = options();
  info.make = [](const SolverOptions& options) {
    if (howOf(options.values) == "make") throw std::runtime_error("no workshop");
    return std::make_unique<Misbehaving>(howOf(options.values));
  };
  return info;
}

SplitterInfo MisbehavingSplitter::info() const {
  SplitterInfo info;
  info.name = "misbehaving";
  info.description = "cuts wrong pieces";
  info.options = options();
  info.make = [](const SplitRequest& request, const SplitQuestion& question) {
    return std::make_unique<MisbehavingPieces>(question.instance, howOf(request.values));
  };
  return info;
}

}  // namespace split_mapf::test
