#pragma once

namespace split_mapf {

/// Goes up with every change that a plug-in built before it does not survive: of SolverPlugin and
/// SplitterPlugin, and of what they hand over or get (Solver, Splitter, Instance, Plan, Deadline).
/// A plug-in built for another number is refused when it is loaded.
constexpr int kPluginInterface = 1;

/// What plug-ins of all kinds have in common.
class Plugin {
 public:
  virtual ~Plugin() = default;
  /// Which version of the interface it was built for.
  int builtFor() const { return built_for_; }

 private:
  const int built_for_ = kPluginInterface;
};

}  // namespace split_mapf
