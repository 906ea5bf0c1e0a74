#pragma once

#include <cstddef>
#include <string>

namespace split_mapf {

/// Reads a whole file. @throws InputError naming the file and the system's reason.
std::string readFile(const std::string& path);
/// Writes a whole file. @throws InputError naming the file and the system's reason.
void writeFile(const std::string& path, const std::string& bytes);

/// Ends the reading of a text file: "path:line: message".
[[noreturn]] void failAtLine(const std::string& path, std::size_t line, const std::string& message);
/// Ends the reading of a binary file: "path: byte N: message".
[[noreturn]] void failAtByte(const std::string& path, std::size_t byte, const std::string& message);

}  // namespace split_mapf
