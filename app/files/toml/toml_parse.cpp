// SPDX-License-Identifier: Apache-2.0
#include "app/files/toml/toml_parse.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace orbwatch::app::files {
namespace {

/// Reads the structure of a TOML text, without its values. A text that is not valid TOML may be
/// read differently after its first error, where the library stops.
class DepthScan {
 public:
  explicit DepthScan(std::string_view text) : text_(text) {}

  /// Line, from 1, in which the text is nested too deeply; nullopt if there is none.
  std::optional<int> line_too_deep() {
    while (at_ < text_.size()) {
      read_next();
      if (outer_ + key_ + dots_ > kDeepestToml) return line_;
    }
    return std::nullopt;
  }

 private:
  void read_next() {
    const char c = text_[at_];
    if (c == '"' || c == '\'') return skip_string(c);
    if (c == '#') {
      at_ = std::min(text_.find('\n', at_), text_.size());
      return;
    }
    ++at_;
    switch (c) {
      case '\n':
        ++line_;
        [[fallthrough]];
      case ',':
        key_ = dots_ = 0;
        break;
      case '=':
        key_ = std::exchange(dots_, 0);
        break;
      case '.':
        ++dots_;
        break;
      case '{':
      case '[':
        open();
        break;
      case '}':
      case ']':
        close();
        break;
      default:
        break;
    }
  }

  void open() {
    open_.push_back(key_ + 1);
    outer_ += key_ + 1;
    key_ = dots_ = 0;
  }

  void close() {
    if (!open_.empty()) {
      outer_ -= open_.back();
      open_.pop_back();
    }
    key_ = dots_ = 0;
  }

  /// Skips a string of either kind; three quotes begin and end one of several lines, which may have
  /// two more at its end.
  void skip_string(char quote) {
    const bool is_long = text_.substr(at_, 3) == std::string(3, quote);
    at_ += is_long ? 3 : 1;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\\' && quote == '"') {
        line_ += text_.substr(at_ + 1, 1) == "\n" ? 1 : 0;
        at_ += 2;
      } else if (c == quote && is_long) {
        const std::size_t end = std::min(text_.find_first_not_of(quote, at_), text_.size());
        const std::size_t quotes = std::min<std::size_t>(end - at_, 5);
        at_ += quotes;
        if (quotes >= 3) return;
      } else if (c == '\n' && !is_long) {
        return;  // an error, at which the library stops
      } else {
        if (c == '\n') ++line_;
        ++at_;
        if (c == quote) return;
      }
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
  int dots_ = 0;           // dots since the last delimiter
  int key_ = 0;            // dots in the key whose value follows
  int outer_ = 0;          // sum of open_
  std::vector<int> open_;  // depth added by each open brace or bracket
};

}  // namespace

toml::table parse_toml(const std::string& text, const std::string& name) {
  if (const auto line = DepthScan(text).line_too_deep()) {
    const std::string description =
        "keys and brackets are nested deeper than " + std::to_string(kDeepestToml);
    throw toml::parse_error(description.c_str(),
                            toml::source_position{static_cast<toml::source_index>(*line), 1});
  }
  return toml::parse(text, name);
}

}  // namespace orbwatch::app::files
