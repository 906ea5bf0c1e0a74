#pragma once

#include <memory>
#include <string>
#include <vector>

#include "split_mapf/plugin/methods.h"

namespace split_mapf {

/// Finds solvers and splitters of other packages by pluginlib: classes with the bases
/// split_mapf::SolverPlugin and split_mapf::SplitterPlugin, which packages that depend on this one
/// export as `<split_mapf plugin="${prefix}/plugin.xml"/>`. Their libraries stay loaded as long as
/// this object lives, which is longer than what it adds.
class PluginLoader {
 public:
  PluginLoader();
  ~PluginLoader();
  PluginLoader(const PluginLoader&) = delete;
  PluginLoader& operator=(const PluginLoader&) = delete;

  /// Adds the classes of these names. @throws OptionError naming the one that is not there, or
  /// cannot be loaded or added; and the classes that there are.
  void load(const std::vector<std::string>& classes, Methods& methods);

 private:
  struct Loaders;
  std::unique_ptr<Loaders> loaders_;  ///< from the first class on
};

}  // namespace split_mapf
