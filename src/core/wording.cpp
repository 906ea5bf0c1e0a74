#include "split_mapf/core/wording.h"

#include <algorithm>
#include <cstdio>

namespace split_mapf {
namespace {

/// Bytes of the UTF-8 character that begins at `at`; 0 where none does.
std::size_t lengthOfCharacter(const std::string& text, std::size_t at) {
  const auto byte = [&text](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned first = byte(at);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xc0U) != 0x80U) return 0;
  }
  const unsigned second = byte(at + 1);
  // Overlong forms, surrogates, and what lies beyond U+10FFFF.
  const bool is_none = (first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||
                       (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f);
  return is_none ? 0 : length;
}

/// Whether a character moves the cursor, the writing's direction, or nothing that can be seen.
bool isHarmful(const std::string& character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return first < 0x20 || first == 0x7f;
  const auto second = static_cast<unsigned char>(character[1]);
  if (character.size() == 2) return first == 0xc2 && second < 0xa0;  // C1 controls
  if (character.size() > 3) return false;
  const auto third = static_cast<unsigned char>(character[2]);
  if (first == 0xef) return second == 0xbb && third == 0xbf;  // byte order mark
  if (first != 0xe2) return false;
  const bool zero_width_or_mark = second == 0x80 && third >= 0x8b && third <= 0x8f;
  const bool separator_or_embedding = second == 0x80 && third >= 0xa8 && third <= 0xae;
  const bool isolate = second == 0x81 && third >= 0xa0 && third <= 0xaf;
  return zero_width_or_mark || separator_or_embedding || isolate;
}

std::string escaped(const std::string& bytes) {
  constexpr const char* kHexDigits = "0123456789abcdef";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text += "\\x";
    text += kHexDigits[byte >> 4U];
    text += kHexDigits[byte & 0xfU];
  }
  return text;
}

}  // namespace

std::string shown(const std::string& text) {
  constexpr std::size_t kEllipsis = 3;
  std::string out;
  std::string out_if_cut;  // what leaves room for the ellipsis
  std::size_t characters = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = lengthOfCharacter(text, at);
    std::string piece = text.substr(at, std::max<std::size_t>(length, 1));
    std::size_t width = 1;
    if (length == 0 || isHarmful(piece)) {
      piece = escaped(piece);
      width = piece.size();
    }
    characters += width;
    if (characters > kMostShown) return out_if_cut + "...";
    out += piece;
    if (characters + kEllipsis <= kMostShown) out_if_cut = out;
    at += std::max<std::size_t>(length, 1);
  }
  return out;
}

bool isUtf8(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = lengthOfCharacter(text, at);
    if (length == 0) return false;
    at += length;
  }
  return true;
}

std::string quote(const std::string& text) { return "'" + shown(text) + "'"; }

std::string counted(std::uint64_t number, const std::string& noun, const std::string& plural) {
  if (number == 1) return "1 " + noun;
  return std::to_string(number) + " " + (plural.empty() ? noun + "s" : plural);
}

std::string numeral(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

}  // namespace split_mapf
