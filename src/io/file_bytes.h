#pragma once

#include <cstddef>
#include <sstream>
#include <string>

namespace split_mapf {

/// Reads a whole file. @throws InputError naming the file and the system's reason.
std::string readFile(const std::string& path);
/// What was written into the stream. @throws std::bad_alloc where memory ran out underway, which a
/// stream keeps to itself, so that its text ends anywhere.
std::string wholeText(const std::ostringstream& out);
/// Writes a whole file, or none: it is made beside `path` and takes its place when it is whole, so
/// where it fails what was there stays, and owner and mode stay in any case. Pipes and devices, a
/// file with several names, of another owner, or in a folder that takes no other, are written as
/// they are. @throws InputError naming the file and the system's reason.
void writeFile(const std::string& path, const std::string& bytes);

/// Ends the reading of a text file: "path:line: message".
[[noreturn]] void failAtLine(const std::string& path, std::size_t line, const std::string& message);
/// Ends the reading of a binary file: "path: byte N: message".
[[noreturn]] void failAtByte(const std::string& path, std::size_t byte, const std::string& message);

}  // namespace split_mapf
