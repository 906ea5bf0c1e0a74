// Plug-ins out of shared libraries, without ROS.
#include <dlfcn.h>

#include <exception>
#include <memory>
#include <string>
#include <utility>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/plugin/export_plugins.h"
#include "split_mapf/plugin/methods.h"

namespace split_mapf {
namespace {

class AddingSink : public PluginSink {
 public:
  AddingSink(const std::string& file, Methods& methods) : file_(file), methods_(methods) {}
  void take(std::unique_ptr<SolverPlugin> plugin) override {
    addSolver(std::move(plugin), file_, methods_);
    ++taken_;
  }
  void take(std::unique_ptr<SplitterPlugin> plugin) override {
    addSplitter(std::move(plugin), file_, methods_);
    ++taken_;
  }
  int taken() const { return taken_; }

 private:
  const std::string& file_;
  Methods& methods_;
  int taken_ = 0;
};

[[noreturn]] void refuseLibrary(const std::string& file, const std::string& why) {
  throw OptionError("plug-in library " + quote(file) + " " + why);
}

}  // namespace

void loadPlugins(const std::string& file, Methods& methods) {
  // A name without a slash would be searched for where the system has its libraries.
  const std::string path = file.find('/') == std::string::npos ? "./" + file : file;
  void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr)
    refuseLibrary(file, std::string("cannot be loaded: ") + shown(::dlerror()));
  // POSIX has it that what dlsym() finds may be made a function.
  const auto export_plugins = reinterpret_cast<ExportPlugins>(::dlsym(library, kExportPluginsName));
  if (export_plugins == nullptr) {
    refuseLibrary(file, "exports no plug-ins: SPLIT_MAPF_EXPORT_PLUGINS(...) is expected in it");
  }
  AddingSink sink(file, methods);
  try {
    export_plugins(sink);
  } catch (const OptionError&) {
    throw;
  } catch (const std::exception& error) {
    refuseLibrary(file, std::string("threw while it was loaded: ") + shown(error.what()));
  } catch (...) {
    refuseLibrary(file, "threw something that is no std::exception while it was loaded");
  }
  if (sink.taken() == 0) refuseLibrary(file, "exports no plug-ins");
}

}  // namespace split_mapf
