#pragma once

namespace split_mapf {

/// Made by cmake/source_hash.cmake whenever a source changes: version and hash of all sources on
/// which plans depend, compiler and options.
const char* sourceHash();

}  // namespace split_mapf
