#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <XmlRpcValue.h>

namespace split_mapf {

/// Reads typed values out of a namespace of ROS parameters and remembers which ones it read. A
/// parameter that is not there leaves its target as it is.
/// Every read throws OptionError naming parameter, value and expected type.
class ParameterReader {
 public:
  /// @param parameters  a struct of name and value, or an invalid value when there are none.
  explicit ParameterReader(const XmlRpc::XmlRpcValue& parameters) : parameters_(parameters) {}

  bool has(const std::string& name) { return find(name) != nullptr; }
  void read(const std::string& name, std::string& target);
  void read(const std::string& name, bool& target);
  /// An integer is a number too.
  void read(const std::string& name, double& target);
  void read(const std::string& name, std::vector<std::string>& target);
  /// @param range  smallest and greatest value allowed.
  std::int64_t readInteger(const std::string& name, std::int64_t default_value,
                           std::pair<std::int64_t, std::int64_t> range);

  /// A finite number above 0, or from 0 on.
  double readPositive(const std::string& name, double default_value, bool or_zero = false);

  /// Names of parameters that no read asked for.
  std::vector<std::string> unreadNames();
  /// Warns of each of them.
  void warnOfUnread();

 private:
  /// The value, or null when it is missing.
  XmlRpc::XmlRpcValue* find(const std::string& name);

  XmlRpc::XmlRpcValue parameters_;
  std::set<std::string> asked_;
};

}  // namespace split_mapf
