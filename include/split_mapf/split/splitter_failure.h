#pragma once

#include <stdexcept>
#include <string>

#include "split_mapf/core/termination.h"

namespace split_mapf {

/// Thrown by a splitter that cannot go on, which only those of plug-ins do. The run that asked it
/// ends with this termination, and what() as its message.
class SplitterFailure : public std::runtime_error {
 public:
  SplitterFailure(Termination termination, const std::string& what)
      : std::runtime_error(what), termination_(termination) {}
  Termination termination() const { return termination_; }

 private:
  Termination termination_;
};

}  // namespace split_mapf
