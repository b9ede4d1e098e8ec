// SPDX-License-Identifier: Apache-2.0
#include "app/model/plain_text.h"

#include <cstdint>

namespace orbwatch::app {
namespace {

struct Character {
  std::size_t bytes = 0;  ///< 0: `text` does not begin with a valid character
  char32_t code = 0;
};

unsigned byte_at(std::string_view text, std::size_t at) {
  return static_cast<unsigned char>(text[at]);
}

/// Length in bytes of a character that begins with `first`.
std::size_t length_of(unsigned first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first <= 0xdf) return 2;
  if (first >= 0xe0 && first <= 0xef) return 3;
  return first >= 0xf0 && first <= 0xf4 ? 4 : 0;
}

Character first_of(std::string_view text) {
  const unsigned first = byte_at(text, 0);
  const std::size_t bytes = length_of(first);
  if (bytes == 0 || bytes > text.size()) return {};
  char32_t code = bytes == 1 ? first : first & (0xffU >> (bytes + 1));
  for (std::size_t n = 1; n < bytes; ++n) {
    const unsigned next = byte_at(text, n);
    if ((next & 0xc0U) != 0x80) return {};
    code = code << 6 | (next & 0x3fU);
  }
  const bool is_too_long = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
  const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
  if (is_too_long || is_surrogate || code > 0x10ffff) return {};
  return {bytes, code};
}

/// Control characters, line and paragraph separators, and those of bidirectional writing.
bool controls(char32_t code) {
  const auto within = [code](char32_t from, char32_t to) { return code >= from && code <= to; };
  return code < 0x20 || within(0x7f, 0x9f) || within(0x200e, 0x200f) || within(0x2028, 0x202e) ||
         within(0x2066, 0x2069) || code == 0x061c;
}

}  // namespace

std::string plain_text(std::string_view text, std::size_t most) {
  std::string plain;
  while (!text.empty()) {
    const Character character = first_of(text);
    const std::size_t bytes = character.bytes == 0 ? 1 : character.bytes;
    const bool is_shown = character.bytes > 0 && !controls(character.code);
    const std::string_view shown = is_shown ? text.substr(0, bytes) : "?";
    if (plain.size() + shown.size() > most) break;
    plain += shown;
    text.remove_prefix(bytes);
  }
  return plain;
}

}  // namespace orbwatch::app
