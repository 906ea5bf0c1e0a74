#include "split_mapf/plugin/methods.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "plugin/guarded_solver.h"
#include "plugin/guarded_splitter.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

[[noreturn]] void refuse(const std::string& origin, const std::string& why) {
  throw OptionError("plug-in " + quote(origin) + " " + why);
}

/// Calls a plug-in outside of any search: its own OptionErrors are its users' to read.
template <typename Part>
auto withOptionErrors(const std::string& called, const Part& part) {
  try {
    return part();
  } catch (const OptionError&) {
    throw;
  } catch (const std::exception& error) {
    throw OptionError(called + " threw: " + shown(error.what()));
  } catch (...) {
    throw OptionError(called + " threw something that is no std::exception");
  }
}

template <typename Plugin>
auto infoOf(const Plugin& plugin, const std::string& origin) {
  if (plugin.builtFor() != kPluginInterface) {
    refuse(origin, "was built for version " + std::to_string(plugin.builtFor()) +
                       " of the interface of plug-ins; this program has version " +
                       std::to_string(kPluginInterface) + ": build it anew");
  }
  auto info = withOptionErrors("plug-in " + quote(origin), [&] { return plugin.info(); });
  const bool is_word =
      !info.name.empty() && std::all_of(info.name.begin(), info.name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
      });
  if (!is_word || info.name == "auto" || info.name == "none") {
    refuse(origin, "calls itself " + quote(info.name) +
                       "; a name of a-z, 0-9 and _ is expected, and none of auto and none");
  }
  if (!info.make) refuse(origin, "has no `make`");
  return info;
}

/// Adds what is made; a name that is taken is the plug-in's fault.
template <typename Registry, typename Info>
void add(Registry& registry, Info info, const std::string& origin) {
  try {
    registry.add(std::move(info));
  } catch (const std::invalid_argument& taken) {
    refuse(origin, std::string("cannot be added: ") + taken.what());
  }
}

/// Lets a plug-in live as long as the program, whatever becomes of the methods: a call of it that
/// was given up may use it while main() ends.
void keep(std::shared_ptr<const void> plugin) {
  static std::mutex mutex;
  static auto& kept = *new std::vector<std::shared_ptr<const void>>;  // never destroyed
  const std::lock_guard<std::mutex> lock(mutex);
  kept.push_back(std::move(plugin));
}

}  // namespace

void addSolver(std::shared_ptr<const SolverPlugin> plugin, const std::string& origin,
               Methods& methods) {
  SolverInfo info = infoOf(*plugin, origin);
  const std::string called = "solver " + quote(info.name) + " of plug-in " + quote(origin);
  info.traits = guardedTraits(info.traits);
  info.description += " (plug-in " + shown(origin) + ")";
  info.make = [inner_make = std::move(info.make), called, name = info.name, traits = info.traits,
               watch = std::make_shared<CallWatch>()](const SolverOptions& options) {
    std::shared_ptr<const Solver> inner =
        withOptionErrors(called, [&] { return inner_make(options); });
    if (!inner) throw OptionError(called + " made none");
    return std::make_unique<GuardedSolver>(name, called, traits, std::move(inner),
                                           options.objective, watch);
  };
  add(methods.solvers, std::move(info), origin);
  keep(std::move(plugin));
}

void addSplitter(std::shared_ptr<const SplitterPlugin> plugin, const std::string& origin,
                 Methods& methods) {
  SplitterInfo info = infoOf(*plugin, origin);
  const std::string called = "splitter " + quote(info.name) + " of plug-in " + quote(origin);
  if (info.makes || info.uses_ways) {
    refuse(origin, "has `makes` or `uses_ways`, which are for splitters of this package");
  }
  info.from_plugin = true;
  info.description += " (plug-in " + shown(origin) + ")";
  if (info.check) {
    info.check = [check = std::move(info.check), called](const SplitRequest& request) {
      withOptionErrors(called, [&] { check(request); });
    };
  }
  info.make = [inner_make = std::move(info.make), called, watch = std::make_shared<CallWatch>()](
                  const SplitRequest& request, const SplitQuestion& question) {
    return std::make_unique<GuardedSplitter>(called, inner_make, request, question, watch);
  };
  add(methods.splitters, std::move(info), origin);
  keep(std::move(plugin));
}

}  // namespace split_mapf
