#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/files/toml_reader.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Changes values of a hand-written TOML text; comments, order, blank lines and ends of lines stay.
/// Every change refers to the text as it was given: none sees another. Thread-bound.
class TomlEdit {
 public:
  /// Error: no TOML; `name` is the file's, for the message.
  static Result<TomlEdit> make(const std::string& text, const std::string& name);

  // A copy of a toml::table does not know where in the text it stood.
  TomlEdit(TomlEdit&&) = default;
  TomlEdit& operator=(TomlEdit&&) = default;

  /// The text's tables, which name the places of changes.
  const toml::table& root() const { return root_; }

  /// What stands in the text for a value.
  std::string_view text_of(const toml::node& value) const;

  /// Puts `text`, in TOML's notation, in the place of a value.
  void replace(const toml::node& value, const std::string& text);

  /// Gives `key` of `table`, a table with a header of its own, a value in TOML's notation: in place
  /// of the old one, else in a line at the table's end.
  void set(const toml::table& table, std::string_view key, const std::string& value);

  /// Removes a value with its line, or a table with its header and all its values; comments before
  /// the next header stay. Nothing happens without such a key.
  void remove(const toml::table& table, std::string_view key);

  /// Removes a table that has a header of its own, with the tables within it; comments before the
  /// next header stay.
  void remove(const toml::table& table);

  /// Adds lines, which end with "\n" here, at the end of `table` and the tables within it: a new
  /// table, say.
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

  std::string text_;  ///< with an end of its last line
  bool lacks_end_;    ///< that was not there
  toml::table root_;
  std::vector<std::size_t> lines_;    ///< where each begins; line 1 is the first
  std::vector<std::size_t> headers_;  ///< lines of headers, ascending
  std::vector<Change> changes_;
};

}  // namespace orbwatch::app
