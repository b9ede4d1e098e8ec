// SPDX-License-Identifier: Apache-2.0
#include "app/cli/support/secret_value.h"

#include <algorithm>

namespace orbwatch::app::cli::support {
namespace {

std::size_t after_space(std::string_view text, std::size_t at) {
  return std::min(text.find_first_not_of(" \t", at), text.size());
}

std::size_t end_of_line(std::string_view text, std::size_t at) {
  return std::min(text.find_first_of("\r\n", at), text.size());
}

/// The end of a text in quotes, which are one character or, in TOML, three.
std::size_t end_of_quoted(std::string_view text, std::size_t at) {
  const std::string_view three = text.substr(at, 3);
  const char quote = text[at];
  if (three.size() == 3 && three.find_first_not_of(quote) == three.npos) {
    const std::size_t end = text.find(three, at + 3);
    return end == text.npos ? text.size() : end + 3;
  }
  for (std::size_t i = at + 1; i < text.size() && text[i] != '\n'; ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (text[i] == quote) {
      return i + 1;
    }
  }
  return end_of_line(text, at);
}

/// The end of a list or table, over lines.
std::size_t end_of_bracketed(std::string_view text, std::size_t at) {
  int depth = 0;
  while (at < text.size()) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = std::max(end_of_quoted(text, at), at + 1);
      continue;
    }
    if (c == '[' || c == '{') ++depth;
    ++at;
    if ((c == ']' || c == '}') && --depth == 0) return at;
  }
  return text.size();
}

bool is_not_secret(std::string_view value) {
  value = value.substr(0, value.find_last_not_of(" \t") + 1);
  return value == "true" || value == "false" || value == "null";
}

/// A value at `at`; after a name in quotes, as in JSON, one without quotes ends at a comma or
/// bracket.
Span value_at(std::string_view text, std::size_t at, bool is_json) {
  if (at >= text.size()) return {};
  if (text[at] == '"' || text[at] == '\'') return {at, end_of_quoted(text, at)};
  if (text[at] == '[' || text[at] == '{') return {at, end_of_bracketed(text, at)};
  std::size_t end = end_of_line(text, at);
  if (is_json) end = std::min(text.find_first_of(",]}\r\n", at), text.size());
  return is_not_secret(text.substr(at, end - at)) ? Span{} : Span{at, end};
}

}  // namespace

Span secret_value(std::string_view text, std::size_t at) {
  std::size_t begin = at;
  while (begin > 0 && is_name_character(text[begin - 1])) --begin;
  std::size_t end = at;
  while (end < text.size() && (is_name_character(text[end]) || text[end] == '.')) ++end;
  const char before = begin > 0 ? text[begin - 1] : ' ';
  if (before == '/') return {};  // the end of an element of XML
  if (before == '<') return {end, std::min(text.find('<', end), text.size())};
  const bool is_option = text.substr(begin).starts_with("--");
  const bool is_quoted = end < text.size() && (text[end] == '"' || text[end] == '\'');
  const std::size_t separator = after_space(text, end + (is_quoted ? 1 : 0));
  if (separator >= text.size()) return {};
  switch (text[separator]) {
    case '=':
    case ':':
      return value_at(text, after_space(text, separator + 1), is_quoted);
    default:
      if (is_option && separator > end) return value_at(text, separator, false);
      return {};
  }
}

}  // namespace orbwatch::app::cli::support
