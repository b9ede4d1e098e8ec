// SPDX-License-Identifier: Apache-2.0
#include "app/files/toml/toml_edit.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <type_traits>

#include "app/files/toml/finding.h"

namespace orbwatch::app::files {
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

/// Value of a leaf in both trees; NaN equals NaN.
bool is_same_value(const toml::node& a, const toml::node& b) {
  return a.visit([&b](const auto& value) {
    using Node = std::remove_cvref_t<decltype(value)>;
    if constexpr (toml::is_container<Node>) {
      return false;
    } else {
      const auto& other = static_cast<const Node&>(b);
      if constexpr (std::is_same_v<Node, toml::value<double>>) {
        if (std::isnan(value.get())) return std::isnan(other.get());
      }
      return value.get() == other.get();
    }
  });
}

/// Path of the first node that differs, such as ".camera[1].pose"; nullopt: the trees are equal.
std::optional<std::string> first_difference(const toml::node& a, const toml::node& b) {
  if (a.type() != b.type()) return "";
  if (const toml::table* table = a.as_table()) {
    const toml::table& other = *b.as_table();
    for (const auto& [key, node] : *table) {
      const toml::node* there = other.get(key.str());
      const auto inner = there ? first_difference(node, *there) : "";
      if (inner) return "." + std::string(key.str()) + *inner;
    }
    for (const auto& [key, node] : other) {
      if (!table->contains(key.str())) return "." + std::string(key.str());
    }
    return std::nullopt;
  }
  if (const toml::array* list = a.as_array()) {
    const toml::array& other = *b.as_array();
    for (std::size_t i = 0; i < std::max(list->size(), other.size()); ++i) {
      const bool is_both = i < list->size() && i < other.size();
      const auto inner = is_both ? first_difference((*list)[i], other[i]) : "";
      if (inner) return "[" + std::to_string(i) + "]" + *inner;
    }
    return std::nullopt;
  }
  return is_same_value(a, b) ? std::nullopt : std::optional<std::string>("");
}

constexpr const char* kAdvice = "; write each table that changes with a header of its own";

}  // namespace

Result<TomlEdit> TomlEdit::make(const std::string& text, const std::string& name) {
  try {
    return TomlEdit(text, name, parse_toml(text));
  } catch (const toml::parse_error& error) {
    return fail(one_line(name + ":" + std::to_string(error.source().begin.line) + ": " +
                         std::string(error.description())));
  }
}

TomlEdit::TomlEdit(std::string text, std::string name, toml::table root)
    : text_(std::move(text)),
      lacks_end_(!text_.empty() && text_.back() != '\n'),
      name_(std::move(name)),
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
  values_[&value] = text;
  add_change(offset(value.source().begin), offset(value.source().end), text);
}

void TomlEdit::set(const toml::table& table, const std::string& key, const std::string& value) {
  if (const toml::node* old = table.get(key)) return replace(*old, value);
  const std::size_t header = line_of_header(table);
  const std::size_t end = end_of_values(header, next_header(header));
  const std::string line = key + " = " + value + "\n";
  additions_.emplace(&table, line);
  add_change(end, end, line);
}

void TomlEdit::remove(const toml::table& table, std::string_view key) {
  const toml::node* node = table.get(key);
  if (!node) return;
  const toml::table* inner = node->as_table();
  if (inner && !inner->is_inline()) return remove(*inner);
  values_[node] = std::nullopt;
  const toml::source_region& place = node->source();
  add_change(line_begin(place.begin.line), line_begin(place.end.line + 1), "");
}

void TomlEdit::remove(const toml::table& table) {
  values_[&table] = std::nullopt;
  add_change(line_begin(line_of_header(table)), end_of(table), "");
}

void TomlEdit::add_table(const toml::table& parent, const std::string& header,
                         const std::string& lines) {
  additions_.emplace(&parent, "[" + header.substr(header.rfind('.') + 1) + "]\n" + lines);
  add_header(end_of(parent), "[" + header + "]", lines);
}

void TomlEdit::add_element(const toml::array& list, const std::string& header,
                           const std::string& lines) {
  additions_.emplace(&list, lines);
  const toml::table* last = list.back().as_table();
  add_header(last ? end_of(*last) : text_.size(), "[[" + header + "]]", lines);
}

void TomlEdit::add_list(const toml::table& parent, const std::string& header,
                        const std::vector<std::string>& elements) {
  const std::string key = "[[" + header.substr(header.rfind('.') + 1) + "]]\n";
  std::string list;
  for (const std::string& lines : elements) {
    list += key + lines;
    add_header(end_of(parent), "[[" + header + "]]", lines);
  }
  additions_.emplace(&parent, list);
}

void TomlEdit::add_header(std::size_t at, const std::string& header, const std::string& lines) {
  const auto level = static_cast<int>(std::ranges::count(header, '.'));
  add_change(at, at, "\n" + header + "\n" + lines, level);
}

/// Replaces a part of the text by lines with the line ends of the text's first line.
void TomlEdit::add_change(std::size_t begin, std::size_t end, const std::string& lines, int level) {
  const std::size_t first_end = text_.find('\n');
  const bool has_return =
      first_end != std::string::npos && first_end > 0 && text_[first_end - 1] == '\r';
  std::string text;
  for (const char c : lines) text += c == '\n' && has_return ? "\r\n" : std::string(1, c);
  changes_.push_back({begin, end, text, level});
}

Result<std::string> TomlEdit::finish() const {
  std::string text = changed_text();
  try {
    const auto path = first_difference(intended(root_), parse_toml(text));
    if (!path) return text;
    return fail(
        one_line(name_ + ": the change would make " + path->substr(1) + " wrong" + kAdvice));
  } catch (const toml::parse_error& error) {
    return fail(one_line(name_ + ": is not valid TOML after the change (" +
                         std::string(error.description()) + ")" + kAdvice));
  }
}

/// At one place, new lines come before a removal, and those of nested tables before outer ones.
std::string TomlEdit::changed_text() const {
  std::vector<Change> changes = changes_;
  std::ranges::stable_sort(changes, {}, [](const Change& change) {
    return std::tuple(change.begin, change.end > change.begin, -change.level);
  });
  std::string out;
  std::size_t done = 0;
  for (const Change& change : changes) {
    out += text_.substr(done, std::max(change.begin, done) - done) + change.text;
    done = std::max(change.end, done);
  }
  out += text_.substr(done);
  const bool ends_as_before = done < text_.size();
  if (lacks_end_ && ends_as_before) out.pop_back();
  return out;
}

/// The table after the changes, without the notation of the text. Throws toml::parse_error: a new
/// value is not valid TOML.
toml::table TomlEdit::intended(const toml::table& table) const {
  toml::table copy;
  const auto insert_as = [&copy](const toml::key& key) {
    return [&copy, &key](const auto& value) { copy.insert_or_assign(key.str(), value); };
  };
  for (const auto& [key, node] : table) insert_intended(node, insert_as(key));
  for (auto [addition, end] = additions_.equal_range(&table); addition != end; ++addition) {
    const toml::table added = parse_toml(addition->second);
    for (const auto& [key, node] : added) node.visit(insert_as(key));
  }
  return copy;
}

toml::array TomlEdit::intended(const toml::array& list) const {
  toml::array copy;
  for (const toml::node& node : list) {
    insert_intended(node, [&copy](const auto& value) { copy.push_back(value); });
  }
  for (auto [addition, end] = additions_.equal_range(&list); addition != end; ++addition) {
    copy.push_back(parse_toml(addition->second));
  }
  return copy;
}

/// Passes the node after the changes to `insert`, unless it is removed.
template <class Insert>
void TomlEdit::insert_intended(const toml::node& node, const Insert& insert) const {
  if (const auto change = values_.find(&node); change != values_.end()) {
    if (change->second) parse_toml("value = " + *change->second).get("value")->visit(insert);
  } else if (const toml::table* table = node.as_table()) {
    insert(intended(*table));
  } else if (const toml::array* list = node.as_array()) {
    const toml::array after = intended(*list);
    const bool is_absent = after.empty() && !list->empty();  // `[[name]]` without an element
    if (!is_absent) insert(after);
  } else {
    node.visit(insert);
  }
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

}  // namespace orbwatch::app::files
