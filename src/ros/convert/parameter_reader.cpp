#include "ros/convert/parameter_reader.h"

#include <cmath>
#include <sstream>

#include <ros/console.h>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

using XmlRpc::XmlRpcValue;

[[noreturn]] void refuse(const std::string& name, const XmlRpcValue& value,
                         const std::string& expected) {
  std::ostringstream text;
  value.write(text);
  throw OptionError("parameter ~" + name + " is " + shown(text.str()) + "; " + expected +
                    " is expected");
}

}  // namespace

XmlRpcValue* ParameterReader::find(const std::string& name) {
  asked_.insert(name);
  const bool there =
      parameters_.getType() == XmlRpcValue::TypeStruct && parameters_.hasMember(name);
  return there ? &parameters_[name] : nullptr;
}

void ParameterReader::read(const std::string& name, std::string& target) {
  XmlRpcValue* value = find(name);
  if (value == nullptr) return;
  if (value->getType() != XmlRpcValue::TypeString) refuse(name, *value, "a text");
  target = static_cast<std::string&>(*value);
}

void ParameterReader::read(const std::string& name, bool& target) {
  XmlRpcValue* value = find(name);
  if (value == nullptr) return;
  if (value->getType() != XmlRpcValue::TypeBoolean) refuse(name, *value, "true or false");
  target = static_cast<bool&>(*value);
}

void ParameterReader::read(const std::string& name, double& target) {
  XmlRpcValue* value = find(name);
  if (value == nullptr) return;
  if (value->getType() == XmlRpcValue::TypeInt) {
    target = static_cast<int&>(*value);
  } else if (value->getType() == XmlRpcValue::TypeDouble) {
    target = static_cast<double&>(*value);
  } else {
    refuse(name, *value, "a number");
  }
}

void ParameterReader::read(const std::string& name, std::vector<std::string>& target) {
  XmlRpcValue* value = find(name);
  if (value == nullptr) return;
  if (value->getType() != XmlRpcValue::TypeArray) refuse(name, *value, "a list of texts");
  target.clear();
  for (int i = 0; i < value->size(); ++i) {
    XmlRpcValue& entry = (*value)[i];
    if (entry.getType() != XmlRpcValue::TypeString) refuse(name, *value, "a list of texts");
    target.push_back(static_cast<std::string&>(entry));
  }
}

std::int64_t ParameterReader::readInteger(const std::string& name, std::int64_t default_value,
                                          std::pair<std::int64_t, std::int64_t> range) {
  XmlRpcValue* value = find(name);
  if (value == nullptr) return default_value;
  const std::string expected =
      "a whole number from " + std::to_string(range.first) + " to " + std::to_string(range.second);
  if (value->getType() != XmlRpcValue::TypeInt) refuse(name, *value, expected);
  const std::int64_t number = static_cast<int&>(*value);
  if (number < range.first || number > range.second) refuse(name, *value, expected);
  return number;
}

double ParameterReader::readPositive(const std::string& name, double default_value, bool or_zero) {
  double value = default_value;
  read(name, value);
  if (std::isfinite(value) && (value > 0 || (or_zero && value == 0))) return value;
  throw OptionError("parameter ~" + name + " is " + numeral(value) + "; a number " +
                    (or_zero ? ">= 0" : "> 0") + " is expected");
}

void ParameterReader::warnOfUnread() {
  for (const std::string& name : unreadNames()) {
    ROS_WARN("parameter ~%s is not one of this node", name.c_str());
  }
}

std::vector<std::string> ParameterReader::unreadNames() {
  std::vector<std::string> names;
  if (parameters_.getType() != XmlRpcValue::TypeStruct) return names;
  for (const auto& entry : parameters_) {
    if (asked_.count(entry.first) == 0) names.push_back(entry.first);
  }
  return names;
}

}  // namespace split_mapf
