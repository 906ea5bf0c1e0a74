#pragma once

#include "split_mapf/plugin/plugin_interface.h"
#include "split_mapf/split/splitter_registry.h"

namespace split_mapf {

/// Brings a splitter of somebody else to the programs of this package, see plugin/methods.h. One
/// derives from this and from Splitter or WholeWhereItFails, and exports the class
/// (plugin/export_plugins.h). `--split NAME` asks for it.
///
/// It is held to the same as a solver, see SolverPlugin: each of its calls has a thread of its own
/// and half a second after the deadline; its pieces are checked before they are solved, the joined
/// plan before anything is done to it. Layouts of its own are not shown, and it gets no ways.
class SplitterPlugin : public Plugin {
 public:
  /// The splitter, with `makes` and `uses_ways` left empty. Called once; this object lives as long
  /// as the program. `check` returns at once.
  virtual SplitterInfo info() const = 0;
};

}  // namespace split_mapf
