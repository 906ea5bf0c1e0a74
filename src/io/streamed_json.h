#pragma once

#include <algorithm>
#include <cstdint>
#include <exception>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "split_mapf/core/error.h"

namespace split_mapf {

/// A list of the top level that is taken entry by entry while the file is parsed, so that never
/// more than one entry of it is held as JSON. The file is parsed to its end whatever is wrong with
/// an entry: where it is no JSON, that is what is to be said.
struct StreamedList {
  const char* key;
  std::function<void(const nlohmann::json&)> take;
  int times = 0;                    // that the key was met
  std::uint64_t entries = 0;        // in all of them
  std::exception_ptr trouble = {};  // with the first entry that is wrong

  void takeOne(const nlohmann::json& entry) {
    ++entries;
    if (trouble) return;
    try {
      take(entry);
    } catch (const InputError&) {
      trouble = std::current_exception();
    }
  }
  /// Rethrows what was wrong with an entry.
  void requireSound() const {
    if (trouble) std::rethrow_exception(trouble);
  }
};

/// An object of JSON of which little is kept: the entries of some lists are taken, some other
/// fields stay, and all else is only read over. Not thread-safe.
class StreamedObject {
 public:
  StreamedObject(std::vector<StreamedList*> lists, std::vector<std::string> kept)
      : lists_(std::move(lists)), kept_(std::move(kept)) {}

  /// What stays. @param throws  else a malformed text gives a discarded value.
  /// @throws nlohmann::json::parse_error.
  nlohmann::json parse(const std::string& bytes, bool throws = true) {
    const auto keep = [this](int depth, Event event, nlohmann::json& parsed) {
      return keeps(depth, event, parsed);
    };
    return nlohmann::json::parse(bytes, keep, throws);
  }

 private:
  using Event = nlohmann::json::parse_event_t;

  /// Called with each value that has been read: whether it stays. Keys are at depth 1, entries of
  /// their lists at 2.
  bool keeps(int depth, Event event, nlohmann::json& parsed) {
    if (event == Event::key && depth == 1) return enter(parsed.get_ref<const std::string&>());
    if (depth == 0 || is_kept_) return true;
    if (list_ == nullptr) return false;
    const bool is_whole =
        event == Event::value || event == Event::array_end || event == Event::object_end;
    if (depth != 2 || !is_whole || !in_list_) {
      if (depth == 1 && event == Event::array_start) in_list_ = true;
      return true;
    }
    list_->takeOne(parsed);
    return false;
  }
  bool enter(const std::string& key) {
    const auto found = std::find_if(lists_.begin(), lists_.end(),
                                    [&](const StreamedList* list) { return list->key == key; });
    list_ = found != lists_.end() ? *found : nullptr;
    if (list_ != nullptr) ++list_->times;
    in_list_ = false;
    is_kept_ = std::find(kept_.begin(), kept_.end(), key) != kept_.end();
    return list_ != nullptr || is_kept_;
  }

  std::vector<StreamedList*> lists_;
  std::vector<std::string> kept_;
  StreamedList* list_ = nullptr;  // whose entries are being read
  bool in_list_ = false;          // whether its value is a list
  bool is_kept_ = true;
};

}  // namespace split_mapf
