#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace split_mapf {

/// Bad input from outside: a file, an option, an instance. The message says what was read, where,
/// and what was expected. Caught once at each outer edge (command, node).
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An unknown option, an option value out of range, or a name that nothing is registered under.
class OptionError : public InputError {
 public:
  using InputError::InputError;
};

/// A solver name that the registry does not know.
class UnknownSolverError : public OptionError {
 public:
  using OptionError::OptionError;
};

/// A split specification that does not parse, or whose splitter is not available.
class SplitSpecError : public OptionError {
 public:
  using OptionError::OptionError;
};

/// Why one robot makes an instance ill-posed.
enum class FaultKind {
  kOutsideMap,
  kBlockedCell,
  kDuplicateStart,
  kDuplicateGoal,
};

/// One robot at fault; `robot` is its index in the request.
struct InstanceFault {
  std::uint32_t robot = 0;
  FaultKind kind = FaultKind::kOutsideMap;
  std::string message;
};

/// An ill-posed instance. Lists every fault at once; what() is the first one's message, with the
/// number of further ones.
class InstanceError : public InputError {
 public:
  explicit InstanceError(std::vector<InstanceFault> faults);
  const std::vector<InstanceFault>& faults() const { return faults_; }

 private:
  std::vector<InstanceFault> faults_;
};

}  // namespace split_mapf
