#include "improve/window_descent.h"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include "split_mapf/core/compaction.h"
#include "split_mapf/split/splitter.h"

namespace split_mapf {
namespace {

/// The steps [begin, end] of a plan.
struct Window {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

std::vector<Window> cut(std::uint32_t makespan, const WindowOptions& options) {
  std::vector<Window> windows;
  std::uint32_t end = std::min(options.offset, makespan);
  for (std::uint32_t begin = 0; begin < makespan;) {
    windows.push_back({begin, end});
    begin = end;
    end = std::min(end + options.width, makespan);
  }
  return windows;
}

Plan sliceOf(const Plan& plan, const Window& window) {
  Plan slice;
  for (const Path& path : plan.paths) {
    Path part;
    for (std::uint32_t t = window.begin; t <= window.end; ++t) part.push_back(positionAt(path, t));
    slice.paths.push_back(std::move(part));
  }
  trimToArrival(slice);
  return slice;
}

Instance pieceOf(const Instance& instance, const Plan& plan, const Window& window) {
  std::vector<Vertex> starts;
  std::vector<Vertex> goals;
  for (const Path& path : plan.paths) {
    starts.push_back(positionAt(path, window.begin));
    goals.push_back(positionAt(path, window.end));
  }
  return Instance::fromVertices(instance.sharedGrid(), starts, goals, DistanceExtent::kOnDemand);
}

/// A plan of the piece that is shorter than the window, if the solver finds one.
std::optional<Plan> shorten(const Instance& piece, std::uint32_t length,
                            const WindowOptions& options, const SolverRegistry& solvers,
                            const Deadline& deadline) {
  const std::uint32_t least = makespanLowerBound(piece);
  if (least >= length || length < 2) return std::nullopt;
  SolverOptions asked;
  asked.objective = Objective::kMakespan;
  asked.seed = options.seed;
  asked.expansion_limit = options.expansion_limit;
  // Any plan that is a step shorter will do.
  asked.suboptimality = static_cast<double>(length - 1) / std::max(1U, least);
  SolveResult result = solvers.create(options.solver, asked)->solve(piece, deadline);
  if (!result.plan || makespanOf(*result.plan) >= length) return std::nullopt;
  return std::move(result.plan);
}

}  // namespace

std::optional<Plan> shortenWindows(const Instance& instance, const Plan& plan,
                                   const WindowOptions& options, const SolverRegistry& solvers,
                                   Executor& executor, const Deadline& deadline) {
  const std::vector<Window> windows = cut(makespanOf(plan), options);
  std::vector<Plan> slices(windows.size());
  std::vector<std::optional<Instance>> pieces(windows.size());
  std::atomic<bool> gained{false};
  std::vector<Executor::Job> jobs(windows.size());
  for (std::size_t i = 0; i < windows.size(); ++i) {
    jobs[i].run = [&, i] {
      slices[i] = sliceOf(plan, windows[i]);
      pieces[i] = pieceOf(instance, plan, windows[i]);
      if (deadline.expired()) return;
      const std::uint32_t length = windows[i].end - windows[i].begin;
      std::optional<Plan> shorter = shorten(*pieces[i], length, options, solvers, deadline);
      if (!shorter) return;
      slices[i] = std::move(*shorter);
      gained = true;
    };
  }
  executor.run(std::move(jobs), options.threads, deadline);
  if (!gained) return std::nullopt;
  std::vector<PieceHandle> handles;
  PiecePlans plans;
  for (PieceId i = 0; i < pieces.size(); ++i) {
    handles.push_back(wholePiece(*pieces[i], i));
    plans[i] = std::move(slices[i]);
  }
  const PieceTree tree = PieceTree::sequence(handles);
  Plan shorter = compact(stitch(tree, plans, instance.robots()), instance.graph().size());
  if (makespanOf(shorter) >= makespanOf(plan)) return std::nullopt;
  return shorter;
}

}  // namespace split_mapf
