#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solvability/bridge_structure.h"
#include "solvability/part_tree.h"

namespace split_mapf {

/// Which ranks of a component robots can exchange, when its empty vertices are those of the lowest
/// ranks: each class has the full symmetric group (with empty vertices; without any, robots cannot
/// leave their class, and the loop that it is may allow less). Walking from the root outwards a
/// class ends at a barrier and another begins, so that a class goes by the nearest barrier above.
///
/// @pre the component is no ring, and the tree grows from its GraphPart::root.
class ExchangeClasses {
 public:
  /// Cost: linear in the component. @throws Interrupted.
  ExchangeClasses(const PartTree& tree, const BridgeStructure& structure, std::uint32_t blanks,
                  const Deadline& deadline);

  std::uint32_t classOf(std::uint32_t rank) const { return class_of_[rank]; }

  /// An obstacle between two classes.
  struct Barrier {
    std::uint32_t above = 0;  ///< the class that ends there
    std::uint32_t depth = 0;  ///< number of barriers from the root, itself included
    std::uint32_t first = 0;  ///< the ranks [first, last) lie beyond it
    std::uint32_t last = 0;
    std::uint32_t corridor_end = 0;     ///< rank; the corridor leads up from here ...
    std::uint32_t corridor_length = 0;  ///< ... by so many edges, to a junction or a loop
    /// With so many empty vertices it would be none; nothing where no number helps.
    std::optional<std::uint32_t> blanks_needed;

    bool isBeyond(std::uint32_t rank) const { return first <= rank && rank < last; }
  };

  /// The barrier between two ranks that needs most.
  /// @pre their classes differ, and the component is no path: all its barriers can be overcome.
  const Barrier& hardestBetween(std::uint32_t a, std::uint32_t b) const;

 private:
  /// What a vertex looks up to: the nearest place above where robots can change places.
  struct Outlook {
    PlaceKind place = PlaceKind::kCorridor;  // kCorridor: there is none
    std::uint32_t distance = 0;
    std::uint32_t inner_class = 0;  // to which vertices below belong, barriers apart
  };
  void visit(std::uint32_t rank, const BridgeStructure& structure);
  std::uint32_t addBarrier(Barrier barrier, std::uint32_t above);

  const PartTree& tree_;
  std::uint32_t blanks_;
  std::vector<std::uint32_t> class_of_;
  std::vector<Outlook> outlooks_;
  std::vector<Barrier> barriers_;  // by class; the root's own is none
};

}  // namespace split_mapf
