#include "split_mapf/split/splitter_registry.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include <boost/algorithm/string/join.hpp>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/split/space_splitter.h"
#include "split_mapf/split/time_splitter.h"

namespace split_mapf {
namespace {

bool offers(const std::vector<OptionInfo>& options, const std::string& name) {
  return std::any_of(options.begin(), options.end(),
                     [&](const OptionInfo& option) { return option.name == name; });
}

bool isInNotation(const std::string& word) {
  try {
    parseSplitSpec(word);
    return true;
  } catch (const SplitSpecError&) {
    return false;
  }
}

}  // namespace

void SplitterRegistry::add(SplitterInfo info) {
  const std::string name = info.name;
  if (isInNotation(name)) {
    throw std::invalid_argument("splitter " + quote(name) + " is named like a specification");
  }
  if (!splitters_.emplace(name, std::move(info)).second) {
    throw std::invalid_argument("splitter " + quote(name) + " is registered already");
  }
}

std::vector<std::string> SplitterRegistry::names() const {
  std::vector<std::string> names;
  for (const auto& entry : splitters_) names.push_back(entry.first);
  return names;
}

const SplitterInfo* SplitterRegistry::find(const SplitRequest& request) const {
  if (request.spec.kind == SplitSpec::Kind::kNamed) return &splitters_.at(request.text);
  for (const auto& [name, info] : splitters_) {
    if (info.makes && info.makes(request.spec)) return &info;
  }
  return nullptr;
}

void SplitterRegistry::requireKnown(const std::string& option) const {
  std::set<std::string> known;
  for (const OptionInfo& common : splitOptions()) known.insert(common.name);
  for (const auto& entry : splitters_) {
    for (const OptionInfo& own : entry.second.options) known.insert(own.name);
  }
  if (known.count(option) > 0) return;
  throw OptionError("split option " + quote(option) +
                    " is unknown; there are: " + boost::algorithm::join(known, ", "));
}

void SplitterRegistry::requireOffered(const SplitRequest& request,
                                      const SplitterInfo* splitter) const {
  if (request.values.empty()) return;
  if (splitter == nullptr) {
    throw OptionError("split options need a split, but split " + quote(request.text) +
                      " makes none");
  }
  for (const auto& entry : request.values) {
    if (offers(splitOptions(), entry.first)) continue;
    if (offers(splitter->options, entry.first)) continue;
    std::set<std::string> owners;
    for (const auto& [name, info] : splitters_) {
      if (offers(info.options, entry.first)) owners.insert(name);
    }
    throw OptionError("split option " + quote(entry.first) + " is for splits made by " +
                      boost::algorithm::join(owners, ", ") + ", but split " + quote(request.text) +
                      " is made by " + splitter->name);
  }
}

SplitRequest SplitterRegistry::read(const std::string& text,
                                    const std::map<std::string, std::string>& values,
                                    Objective objective) const {
  SplitRequest request;
  request.text = text;
  request.values = values;
  for (const auto& entry : values) requireKnown(entry.first);
  if (has(text) && !info(text).makes) {
    request.spec.kind = SplitSpec::Kind::kNamed;
    // Its own options are its own, whatever others call theirs.
    std::map<std::string, std::string> common;
    for (const auto& entry : values) {
      if (!offers(info(text).options, entry.first)) common.insert(entry);
    }
    request.options = readSplitOptions(common, objective);
  } else {
    request.options = readSplitOptions(values, objective);
    request.spec = parseSplitSpec(text);
  }
  const SplitterInfo* const splitter = find(request);
  requireOffered(request, splitter);
  if (splitter != nullptr && splitter->check) splitter->check(request);
  return request;
}

const SplitterRegistry& builtinSplitters() {
  static const SplitterRegistry registry = [] {
    SplitterRegistry splitters;
    splitters.add(SpaceSplitter::info());
    splitters.add(TimeSplitter::info());
    return splitters;
  }();
  return registry;
}

}  // namespace split_mapf
