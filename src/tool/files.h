#pragma once

#include <string>

namespace split_mapf::tool {

/// Checks that a file can be written before work is spent on what shall stand in it. Creates and
/// changes nothing. @throws InputError naming the file and what stands in the way.
void requireWritable(const std::string& path);
/// @throws InputError when `path` is there and is no plain file (a pipe, a device), so that another
/// cannot be put in its place.
void requireReplaceable(const std::string& path);

/// Writes a whole file. @throws InputError naming the file and the system's reason.
void writeTextFile(const std::string& path, const std::string& text);
/// The same; `-` stands for standard output.
void writeText(const std::string& path, const std::string& text);

}  // namespace split_mapf::tool
