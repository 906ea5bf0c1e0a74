#pragma once

#include <map>
#include <string>

namespace split_mapf::fuzz {

/// Gives bytes of a stranger to a reader, or to several that read such files; returns whether one
/// took them. Refusing them by InputError is right; any other exception goes through, and any fault
/// of memory is the sanitizers' to find.
using Target = bool (*)(const std::string& bytes);

/// By the name of its folder in fuzz/corpus.
const std::map<std::string, Target>& targets();

}  // namespace split_mapf::fuzz
