#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "split_mapf/core/instance.h"
#include "split_mapf/core/option_info.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/solvability/solvability.h"
#include "split_mapf/split/split_options.h"
#include "split_mapf/split/split_spec.h"
#include "split_mapf/split/splitter.h"

namespace split_mapf {

/// A split that is asked for, before there is an instance.
struct SplitRequest {
  std::string text;  ///< as asked
  SplitSpec spec;
  SplitOptions options;                       ///< what this package's own splitters read
  std::map<std::string, std::string> values;  ///< all options by name, as they were given
};

/// What a splitter is made for. All of it outlives the splitter.
struct SplitQuestion {
  const Instance& instance;
  const SolvabilityChecker& checker;  ///< of the instance's graph
  std::uint64_t seed = 0;
  std::vector<Path> ways;  ///< a shortest path of each robot where they are known; else empty
};

/// A registered splitter.
struct SplitterInfo {
  std::string name;
  std::string description;
  std::vector<OptionInfo> options;  ///< its own
  /// Whether a specification in the paper's notation asks for it, which then alone does; null: its
  /// name does.
  std::function<bool(const SplitSpec&)> makes;
  /// Looks at its options before any work. @throws OptionError. Null: there is nothing to look at.
  std::function<void(const SplitRequest&)> check;
  /// Whether it uses the robots' shortest paths, see drawShortestWay(), for whose drawing the
  /// caller may have threads; null: it does not.
  std::function<bool(const SplitRequest&, const Instance&)> uses_ways;
  /// @throws SplitSpecError for a split that does not fit the instance.
  std::function<std::unique_ptr<Splitter>(const SplitRequest&, SplitQuestion)> make;
  /// Whether pieces that the named solver fails on may go to others (option `rescue`).
  bool rescues = false;
  /// Whether it cuts the map, so that a part of it will not do.
  bool cuts_map = false;
  /// Whether somebody else made it, see plugin/methods.h: a plan of its pieces that is not valid is
  /// its fault, not one of this package.
  bool from_plugin = false;
};

/// Splitters by name. Filled once, then only read: reading is thread-safe.
class SplitterRegistry {
 public:
  /// @throws std::invalid_argument when the name is taken, or is a word of the paper's notation.
  void add(SplitterInfo info);
  /// In order of names.
  std::vector<std::string> names() const;
  bool has(const std::string& name) const { return splitters_.count(name) > 0; }
  /// @pre has(name).
  const SplitterInfo& info(const std::string& name) const { return splitters_.at(name); }
  /// The splitter that a request asks for by name or notation; null: it makes no split.
  const SplitterInfo* find(const SplitRequest& request) const;
  /// Reads a split and its options. @throws SplitSpecError, OptionError.
  SplitRequest read(const std::string& text, const std::map<std::string, std::string>& values,
                    Objective objective) const;

 private:
  void requireKnown(const std::string& option) const;
  void requireOffered(const SplitRequest& request, const SplitterInfo* splitter) const;

  std::map<std::string, SplitterInfo> splitters_;
};

/// The splitters of this package: `space` and `time`.
const SplitterRegistry& builtinSplitters();

}  // namespace split_mapf
