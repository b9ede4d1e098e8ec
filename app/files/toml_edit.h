// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/files/toml_reader.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Changes values of a hand-written TOML text; comments, order, blank lines and line ends are kept.
/// Every change refers to the original text, independent of the others. Thread-bound.
class TomlEdit {
 public:
  /// Error: not TOML; `name` is the file's, for the message.
  static Result<TomlEdit> make(const std::string& text, const std::string& name);

  // Move only: a copy of a toml::table loses its positions in the text.
  TomlEdit(TomlEdit&&) = default;
  TomlEdit& operator=(TomlEdit&&) = default;

  /// Tables of the text, which identify the places of changes.
  const toml::table& root() const { return root_; }

  /// Notation of a value in the text.
  std::string_view text_of(const toml::node& value) const;

  /// Replaces a value by `text`, in TOML's notation.
  void replace(const toml::node& value, const std::string& text);

  /// Sets `key` of `table`, a table with a header of its own, to a value in TOML's notation:
  /// replaces the old one, or adds a line at the table's end.
  void set(const toml::table& table, std::string_view key, const std::string& value);

  /// Removes a value with its line, or a table with its header and all its values; comments before
  /// the next header are kept. Does nothing without such a key.
  void remove(const toml::table& table, std::string_view key);

  /// Removes a table that has a header of its own, with its nested tables; comments before the next
  /// header are kept.
  void remove(const toml::table& table);

  /// Adds lines, which end with "
  /// " here, at the end of `table` and its nested tables, for example a new table.
  void append(const toml::table& table, const std::string& lines);

  /// The changed text.
  std::string text() const;

 private:
  struct Change {
    std::size_t begin;
    std::size_t end;
    std::string text;
  };

  TomlEdit(std::string text, toml::table root);

  void add_lines(std::size_t at, const std::string& lines);
  std::size_t offset(const toml::source_position& position) const;
  std::size_t line_begin(std::size_t line) const;
  std::size_t end_of_values(std::size_t first_line, std::size_t end_line) const;
  std::size_t next_header(std::size_t line) const;
  std::size_t end_of(const toml::table& table) const;

  std::string text_;  ///< text with an end of its last line
  bool lacks_end_;    ///< the original text had no end of its last line
  toml::table root_;
  std::vector<std::size_t> lines_;    ///< start of each line; line 1 is the first
  std::vector<std::size_t> headers_;  ///< lines of headers, ascending
  std::vector<Change> changes_;
};

}  // namespace orbwatch::app
