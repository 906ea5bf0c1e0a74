#pragma once

#include <memory>

#include "split_mapf/plugin/solver_plugin.h"
#include "split_mapf/plugin/splitter_plugin.h"

namespace split_mapf {

/// Takes what a library exports. Implemented by who loads it.
class PluginSink {
 public:
  virtual ~PluginSink() = default;
  virtual void take(std::unique_ptr<SolverPlugin> plugin) = 0;
  virtual void take(std::unique_ptr<SplitterPlugin> plugin) = 0;
};

/// The function that a library of plug-ins has, by its C name.
using ExportPlugins = void (*)(PluginSink& sink);
constexpr const char* kExportPluginsName = "splitMapfExportPlugins";

/// Makes one of each class and hands it over.
template <typename... Plugins>
void handOver(PluginSink& sink) {
  (sink.take(std::make_unique<Plugins>()), ...);
}

}  // namespace split_mapf

/// Written once in a library, outside of namespaces, with all its plug-in classes: lets programs
/// without ROS load them (`split_mapf plan --solver-plugins FILE`). For nodes, which find plug-ins
/// by pluginlib, PLUGINLIB_EXPORT_CLASS stands beside it.
#define SPLIT_MAPF_EXPORT_PLUGINS(...)                                           \
  extern "C" __attribute__((visibility("default"))) void splitMapfExportPlugins( \
      split_mapf::PluginSink& sink) {                                            \
    split_mapf::handOver<__VA_ARGS__>(sink);                                     \
  }
