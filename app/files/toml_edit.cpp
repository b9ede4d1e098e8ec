// SPDX-License-Identifier: Apache-2.0
#include "app/files/toml_edit.h"

#include <algorithm>

namespace orbwatch::app {
namespace {

std::size_t line_of_header(const toml::table& table) { return table.source().begin.line; }

/// Collects the lines of the headers of a table and of its nested tables; inline tables have none.
void collect_headers(const toml::table& table, std::vector<std::size_t>& lines) {
  for (const auto& [key, node] : table) {
    if (const toml::table* inner = node.as_table(); inner && !inner->is_inline()) {
      lines.push_back(line_of_header(*inner));
      collect_headers(*inner, lines);
    }
    const toml::array* list = node.as_array();
    if (!list || !list->is_array_of_tables()) continue;
    for (const toml::node& item : *list) {
      const toml::table& element = *item.as_table();
      if (element.is_inline()) continue;
      lines.push_back(line_of_header(element));
      collect_headers(element, lines);
    }
  }
}

bool is_comment_or_blank(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos || line[first] == '#';
}

}  // namespace

Result<TomlEdit> TomlEdit::make(const std::string& text, const std::string& name) {
  try {
    return TomlEdit(text, parse_toml(text));
  } catch (const toml::parse_error& error) {
    return fail(one_line(name + ":" + std::to_string(error.source().begin.line) + ": " +
                         std::string(error.description())));
  }
}

TomlEdit::TomlEdit(std::string text, toml::table root)
    : text_(std::move(text)),
      lacks_end_(!text_.empty() && text_.back() != '\n'),
      root_(std::move(root)) {
  if (lacks_end_) text_ += '\n';
  lines_.push_back(0);
  for (std::size_t n = 0; n < text_.size(); ++n) {
    if (text_[n] == '\n') lines_.push_back(n + 1);
  }
  collect_headers(root_, headers_);
  std::ranges::sort(headers_);
}

std::string_view TomlEdit::text_of(const toml::node& value) const {
  const std::size_t begin = offset(value.source().begin);
  return std::string_view(text_).substr(begin, offset(value.source().end) - begin);
}

void TomlEdit::replace(const toml::node& value, const std::string& text) {
  changes_.push_back({offset(value.source().begin), offset(value.source().end), text});
}

void TomlEdit::set(const toml::table& table, std::string_view key, const std::string& value) {
  if (const toml::node* old = table.get(key)) return replace(*old, value);
  const std::size_t header = line_of_header(table);
  add_lines(end_of_values(header, next_header(header)), std::string(key) + " = " + value + "\n");
}

void TomlEdit::remove(const toml::table& table, std::string_view key) {
  const toml::node* node = table.get(key);
  if (!node) return;
  const toml::table* inner = node->as_table();
  if (inner && !inner->is_inline()) return remove(*inner);
  const toml::source_region& place = node->source();
  changes_.push_back({line_begin(place.begin.line), line_begin(place.end.line + 1), ""});
}

void TomlEdit::remove(const toml::table& table) {
  changes_.push_back({line_begin(line_of_header(table)), end_of(table), ""});
}

void TomlEdit::append(const toml::table& table, const std::string& lines) {
  add_lines(end_of(table), lines);
}

/// Adds lines with the line ends of the text's first line.
void TomlEdit::add_lines(std::size_t at, const std::string& lines) {
  const std::size_t end = text_.find('\n');
  const bool has_return = end != std::string::npos && end > 0 && text_[end - 1] == '\r';
  std::string added;
  for (const char c : lines) added += c == '\n' && has_return ? "\r\n" : std::string(1, c);
  changes_.push_back({at, at, added});
}

std::string TomlEdit::text() const {
  std::vector<Change> changes = changes_;
  std::ranges::stable_sort(changes, {}, &Change::begin);
  std::string out;
  std::size_t done = 0;
  for (const Change& change : changes) {
    out += text_.substr(done, change.begin - done) + change.text;
    done = change.end;
  }
  out += text_.substr(done);
  const bool ends_as_before = done < text_.size();
  if (lacks_end_ && ends_as_before) out.pop_back();
  return out;
}

/// toml++ counts columns in characters, from 1.
std::size_t TomlEdit::offset(const toml::source_position& position) const {
  std::size_t at = line_begin(position.line);
  for (std::size_t column = 1; column < position.column && at < text_.size(); ++column) {
    do {
      ++at;
    } while (at < text_.size() && (static_cast<unsigned char>(text_[at]) & 0xC0U) == 0x80U);
  }
  return at;
}

std::size_t TomlEdit::line_begin(std::size_t line) const {
  return line <= lines_.size() ? lines_[line - 1] : text_.size();
}

/// Offset after the last value of the lines [first_line, end_line): comments and blank lines before
/// the next header belong to that header.
std::size_t TomlEdit::end_of_values(std::size_t first_line, std::size_t end_line) const {
  std::size_t end = std::min(end_line, lines_.size());
  while (end > first_line + 1 && is_comment_or_blank(std::string_view(text_).substr(
                                     line_begin(end - 1), line_begin(end) - line_begin(end - 1)))) {
    --end;
  }
  return line_begin(end);
}

/// Line of the first header after `line`, or the one after the text.
std::size_t TomlEdit::next_header(std::size_t line) const {
  const auto next = std::ranges::upper_bound(headers_, line);
  return next == headers_.end() ? lines_.size() : *next;
}

std::size_t TomlEdit::end_of(const toml::table& table) const {
  std::vector<std::size_t> own{line_of_header(table)};
  collect_headers(table, own);
  const std::size_t last = std::ranges::max(own);
  return end_of_values(last, next_header(last));
}

}  // namespace orbwatch::app
