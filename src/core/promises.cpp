#include "split_mapf/core/promises.h"

#include <algorithm>

namespace split_mapf {
namespace {

/// One call of growPromises().
class Growth {
 public:
  Growth(const ExecutionGraph& graph, const PromiseRule& rule, Cut& promised)
      : graph_(graph), order_(graph.precedence()), rule_(rule), promised_(promised) {}

  void run() {
    for (std::uint32_t robot = 0; robot < order_.robots(); ++robot) {
      while (mayGrow(robot)) promise(promised_[robot] + 1);
    }
  }

 private:
  bool mayGrow(std::uint32_t robot) const {
    const VisitId last = promised_[robot];
    if (last >= order_.last(robot) || last - graph_.at(robot) >= rule_.ahead) return false;
    const Ring* const ring = graph_.ringOf(last + 1);
    if (ring == nullptr) return hasNobodyBefore(last + 1) && isOpen(last + 1);
    return graph_.isReleased(last + 1) && rule_.joint_rings &&
           std::all_of(ring->begin(), ring->end(),
                       [this](VisitId member) { return isOpen(member); });
  }

  /// A robot is not in its own way: it may come back to a vertex before it is seen to have left it,
  /// and where nobody has seen it for long it may have done so.
  bool hasNobodyBefore(VisitId event) const {
    bool nobody = true;
    graph_.forEachAwaited(event, [&](VisitId awaited, double fraction) {
      const bool own = order_[awaited].robot == order_[event].robot;
      nobody = nobody && (own || graph_.hasDone(awaited, fraction));
    });
    return nobody;
  }

  bool isOpen(VisitId event) const {
    const std::uint32_t robot = order_[event].robot;
    if (rule_.held_back != nullptr && (*rule_.held_back)[robot]) return false;
    if (rule_.limit != nullptr && event > (*rule_.limit)[robot]) return false;
    return rule_.blocked == nullptr || !(*rule_.blocked)[order_[event].vertex];
  }

  /// An event, and the others of its ring.
  void promise(VisitId event) {
    promised_[order_[event].robot] = event;
    const Ring* const ring = graph_.ringOf(event);
    if (ring == nullptr) return;
    for (const VisitId member : *ring) {
      VisitId& last = promised_[order_[member].robot];
      last = std::max(last, member);
    }
  }

  const ExecutionGraph& graph_;
  const Precedence& order_;
  const PromiseRule& rule_;
  Cut& promised_;
};

}  // namespace

void growPromises(const ExecutionGraph& graph, const PromiseRule& rule, Cut& promised) {
  Growth(graph, rule, promised).run();
}

}  // namespace split_mapf
