#pragma once

#include <XmlRpcValue.h>

#include <string>

namespace split_mapf::test {

/// A node's parameters, of which one is set.
inline XmlRpc::XmlRpcValue parametersOf(const std::string& name, const XmlRpc::XmlRpcValue& value) {
  XmlRpc::XmlRpcValue parameters;
  parameters[name] = value;
  return parameters;
}

}  // namespace split_mapf::test
