// SPDX-License-Identifier: Apache-2.0
#include "app/cli/support/comments.h"

#include <algorithm>
#include <cctype>

namespace orbwatch::app::cli::support {
namespace {

std::string without_xml_comments(std::string_view text) {
  constexpr std::string_view kBegin = "<!--", kEnd = "-->";
  std::string out;
  for (std::size_t at = 0;;) {
    const std::size_t begin = text.find(kBegin, at);
    out += text.substr(at, begin - at);
    if (begin == text.npos) return out;
    const std::size_t end = std::min(text.find(kEnd, begin), text.size());
    const auto comment = text.substr(begin, end - begin);
    out.append(static_cast<std::size_t>(std::ranges::count(comment, '\n')), '\n');
    at = std::min(end + kEnd.size(), text.size());
  }
}

/// Position in a text of TOML or YAML: within which quotes, if any.
class Quotes {
 public:
  bool is_inside() const { return !quotes_.empty(); }

  /// Reads the character at `at` and returns the number of characters that belong to it: 3 for
  /// TOML's quotes over lines, 2 for an escaped one.
  std::size_t read(std::string_view text, std::size_t at) {
    const char c = text[at];
    const std::string_view rest = text.substr(at);
    if (is_inside()) {
      if (c == '\\' && quotes_.front() == '"') return std::min<std::size_t>(rest.size(), 2);
      // A quote that is not closed in its line ends there.
      const bool ends = rest.starts_with(quotes_) || (c == '\n' && quotes_.size() == 1);
      const std::size_t length = ends && c != '\n' ? quotes_.size() : 1;
      if (ends) quotes_ = {};
      return length;
    }
    // The apostrophe of a word such as don't, in YAML, is not a quote.
    const bool is_in_word = at > 0 && std::isalnum(static_cast<unsigned char>(text[at - 1])) != 0;
    if ((c != '"' && c != '\'') || is_in_word) return 1;
    const bool is_three = rest.size() >= 3 && rest[1] == c && rest[2] == c;
    quotes_ = rest.substr(0, is_three ? 3 : 1);
    return quotes_.size();
  }

 private:
  std::string_view quotes_;  ///< the opening ones
};

std::string without_hash_comments(std::string_view text) {
  std::string out;
  Quotes quotes;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '#' && !quotes.is_inside()) {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    const std::size_t length = quotes.read(text, at);
    out += text.substr(at, length);
    at += length;
  }
  return out;
}

}  // namespace

std::string without_comments(std::string_view text, std::string_view name) {
  return name.ends_with(".xml") ? without_xml_comments(text) : without_hash_comments(text);
}

}  // namespace orbwatch::app::cli::support
