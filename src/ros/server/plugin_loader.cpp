#include "ros/server/plugin_loader.h"

#include <exception>
#include <utility>

#ifdef SPLIT_MAPF_HAS_PLUGINLIB
#include <boost/algorithm/string/join.hpp>
#include <pluginlib/class_loader.hpp>
#endif

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

[[noreturn]] void refuseClass(const std::string& name, const std::string& why) {
  throw OptionError("parameter ~solver_plugins: class " + quote(name) + " " + why);
}

}  // namespace

#ifdef SPLIT_MAPF_HAS_PLUGINLIB

struct PluginLoader::Loaders {
  pluginlib::ClassLoader<SolverPlugin> solvers{"split_mapf", "split_mapf::SolverPlugin"};
  pluginlib::ClassLoader<SplitterPlugin> splitters{"split_mapf", "split_mapf::SplitterPlugin"};

  std::string names() {
    std::vector<std::string> all = solvers.getDeclaredClasses();
    for (std::string& name : splitters.getDeclaredClasses()) all.push_back(std::move(name));
    return all.empty() ? "no package has any" : "there are: " + boost::algorithm::join(all, ", ");
  }
};

void PluginLoader::load(const std::vector<std::string>& classes, Methods& methods) {
  if (!classes.empty() && !loaders_) loaders_ = std::make_unique<Loaders>();
  for (const std::string& name : classes) {
    try {
      if (loaders_->solvers.isClassAvailable(name)) {
        // Never deleted by the loader: a search that was given up may use it to the end.
        addSolver(
            std::shared_ptr<const SolverPlugin>(loaders_->solvers.createUnmanagedInstance(name)),
            name, methods);
      } else if (loaders_->splitters.isClassAvailable(name)) {
        addSplitter(std::shared_ptr<const SplitterPlugin>(
                        loaders_->splitters.createUnmanagedInstance(name)),
                    name, methods);
      } else {
        refuseClass(name, "is declared by no package; " + loaders_->names());
      }
    } catch (const OptionError&) {
      throw;
    } catch (const std::exception& error) {
      refuseClass(name, std::string("cannot be loaded: ") + error.what());
    } catch (...) {
      refuseClass(name, "cannot be loaded: it threw something that is no std::exception");
    }
  }
}

#else

struct PluginLoader::Loaders {};

void PluginLoader::load(const std::vector<std::string>& classes, Methods& /*methods*/) {
  if (!classes.empty()) {
    refuseClass(classes.front(), "cannot be loaded: this node was built without pluginlib");
  }
}

#endif

PluginLoader::PluginLoader() = default;

PluginLoader::~PluginLoader() = default;

}  // namespace split_mapf
