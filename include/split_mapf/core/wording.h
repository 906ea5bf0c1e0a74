#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace split_mapf {

/// How messages are worded: what a user wrote is shown short and harmless, and nouns agree with
/// their numbers. All functions are thread-safe.

/// Characters of a text that a message shows at most.
constexpr std::size_t kMostShown = 80;

/// A user's text as a message shows it: at most kMostShown characters, the last three of them
/// "..." where it was cut. Valid UTF-8 stays as it is and is never cut inside a character; control
/// characters, invisible marks of direction and bytes that are no UTF-8 become \xNN.
/// Cost: O(kMostShown), however long the text.
std::string shown(const std::string& text);
/// Whether every byte belongs to a character of UTF-8. Cost: O(bytes).
bool isUtf8(const std::string& text);
/// The same as shown() in single quotes.
std::string quote(const std::string& text);

/// "1 robot", "2 robots". @param plural  the noun's, where adding an s does not make it.
std::string counted(std::uint64_t number, const std::string& noun, const std::string& plural = "");

/// A number in at most six digits, however great or small: "0.5", "1e+300", "nan".
std::string numeral(double number);

}  // namespace split_mapf
