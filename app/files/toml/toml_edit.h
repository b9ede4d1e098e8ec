// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/files/toml/toml_parse.h"
#include "proc/image/result.h"

namespace orbwatch::app::files {

/// Changes values of a hand-written TOML text; comments, order, blank lines and line ends are kept.
/// Every change refers to the original text, independent of the others. Thread-bound.
class TomlEdit {
 public:
  /// Error: not TOML; `name` is the file's, for messages.
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
  void set(const toml::table& table, const std::string& key, const std::string& value);

  /// Removes a value with its line, or a table with its header and all its values; comments before
  /// the next header are kept. Does nothing without such a key.
  void remove(const toml::table& table, std::string_view key);

  /// Removes a table that has a header of its own, with its nested tables; comments before the next
  /// header are kept.
  void remove(const toml::table& table);

  /// Adds the table `[header]`, such as "camera.pose", after `parent` and its nested tables;
  /// `lines` are its values, see toml_line().
  void add_table(const toml::table& parent, const std::string& header, const std::string& lines);

  /// Adds the table `[[header]]` after the last one of `list`, which is not empty.
  void add_element(const toml::array& list, const std::string& header, const std::string& lines);

  /// Adds a list of tables, such as `[[region.alarm]]`, after `parent`, which has none, and its
  /// nested tables; `elements` are the values of each, see toml_line().
  void add_list(const toml::table& parent, const std::string& header,
                const std::vector<std::string>& elements);

  /// The changed text. It was read back as a whole: every changed key has its new value, every
  /// removed one is absent, and all others are as before. Error: this is not so, because the
  /// notation of the text does not permit the change; a new value that is not valid TOML.
  Result<std::string> finish() const;

 private:
  struct Change {
    std::size_t begin;
    std::size_t end;
    std::string text;
    int level;  ///< depth of a new table; kDeepestToml for values, which belong to a table before
                ///< it
  };

  TomlEdit(std::string text, std::string name, toml::table root);

  void add_change(std::size_t begin, std::size_t end, const std::string& lines,
                  int level = kDeepestToml);
  void add_header(std::size_t at, const std::string& header, const std::string& lines);
  std::string changed_text() const;
  toml::table intended(const toml::table& table) const;
  toml::array intended(const toml::array& list) const;
  template <class Insert>
  void insert_intended(const toml::node& node, const Insert& insert) const;
  std::size_t offset(const toml::source_position& position) const;
  std::size_t line_begin(std::size_t line) const;
  std::size_t end_of_values(std::size_t first_line, std::size_t end_line) const;
  std::size_t next_header(std::size_t line) const;
  std::size_t end_of(const toml::table& table) const;

  std::string text_;  ///< text with an end of its last line
  bool lacks_end_;    ///< the original text had no end of its last line
  std::string name_;
  toml::table root_;
  std::vector<std::size_t> lines_;    ///< start of each line; line 1 is the first
  std::vector<std::size_t> headers_;  ///< lines of headers, ascending
  std::vector<Change> changes_;

  // Meaning of the changes, by the changed node:
  std::map<const toml::node*, std::optional<std::string>> values_;  ///< nullopt: removed
  /// TOML with the keys that a table gets, or with the values of a list's new table.
  std::multimap<const toml::node*, std::string> additions_;
};

}  // namespace orbwatch::app::files
