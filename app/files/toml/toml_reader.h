// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "app/files/toml/finding.h"
#include "app/files/toml/toml_parse.h"
#include "proc/optics/vec.h"
#include "proc/settings/settings.h"

namespace orbwatch::app::files {

/// Visitor that loads: reads one table of a TOML file into a settings struct. Checks types, ranges
/// and words, and refuses keys that visit() does not name. Thread-bound.
class TomlReader {
 public:
  /// `path`: the table's name in messages, empty at the top.
  TomlReader(const toml::table& table, std::string path, Finding& finding)
      : table_(table), path_(std::move(path)), finding_(finding) {}

  template <class T, class... Constraint>
  void required(const char* key, T& value, const Constraint&... rest) {
    if (!table_.contains(key)) {
      known_.emplace_back(key);
      finding_.refuse(line_of(table_), name(key), "is missing; it must be given");
      return;
    }
    optional(key, value, rest...);
  }

  template <class T, class... Rest>
  void required_if(bool applies, const char* when, const char* key, T& value, const Rest&... rest) {
    if (applies) return required(key, value, rest...);
    refuse_other_case(key, when);
  }

  template <class T, class... Rest>
  void optional_if(bool applies, const char* when, const char* key, T& value, const Rest&... rest) {
    if (applies) return optional(key, value, rest...);
    refuse_other_case(key, when);
  }

  /// Reads a string, a path, a file, a reference, a boolean, or a list of strings.
  template <class T>
  void optional(const char* key, T& value, const char* /*text*/) {
    if (const toml::node* node = find(key)) read(*node, name(key), value);
  }

  /// Reads a number or a list of numbers in a range.
  template <class T>
  void optional(const char* key, T& value, const Range& range, const char* /*text*/) {
    if (const toml::node* node = find(key)) read(*node, name(key), value, range);
  }

  /// Reads a duration as a number of `Period`s.
  template <class T, class Period>
  void optional(const char* key, T& value, const DurationRange<Period>& allowed,
                const char* /*text*/) {
    if (const toml::node* node = find(key)) read(*node, name(key), value, allowed);
  }

  /// Reads a word that represents a value.
  template <class T, std::size_t N>
  void optional(const char* key, T& value, const std::array<Word<T>, N>& words,
                const char* /*text*/) {
    const toml::node* node = find(key);
    if (!node) return;
    const auto given = node->value<std::string>();
    if (const T* found = given ? find_word(words, *given) : nullptr) {
      value = *found;
      return;
    }
    finding_.refuse(line_of(*node), name(key),
                    describe(*node) + " is not allowed; use one of: " + joined(words));
  }

  /// Reads a word that is the value itself.
  template <std::size_t N>
  void optional(const char* key, std::string& value, const std::array<std::string_view, N>& words,
                const char* text) {
    std::array<Word<std::string_view>, N> named;
    for (std::size_t i = 0; i < N; ++i) named[i] = {words[i], words[i]};
    std::string_view chosen = value;
    optional(key, chosen, named, text);
    if (chosen != value) value = std::string(chosen);
  }

  template <class T>
  void table(const char* key, T& value, const char* /*text*/) {
    if (const toml::table* nested = find_table(key)) read_table(*nested, name(key), value);
  }

  template <class T>
  void table(const char* key, std::optional<T>& value, const char* /*text*/) {
    if (const toml::table* nested = find_table(key)) {
      read_table(*nested, name(key), value.emplace());
    }
  }

  template <class T>
  void tables(const char* key, std::vector<T>& values, std::size_t least, std::size_t most,
              const char* /*text*/) {
    for (const toml::table* nested : find_tables(key, least, most)) {
      read_table(*nested, name(key), values.emplace_back());
    }
  }

  /// Reads a word, and the table of that name with the settings of its alternative. The tables of
  /// the other alternatives may stay in the file; they are checked, too.
  template <class... Alternatives>
  void one_of(const char* key, std::variant<Alternatives...>& value, const char* text) {
    constexpr std::array<std::string_view, sizeof...(Alternatives)> kNames{Alternatives::kName...};
    std::string chosen;
    required(key, chosen, kNames, text);
    const auto read_alternative = [&]<class Alternative>(std::type_identity<Alternative>) {
      const std::string own(Alternative::kName);
      const toml::table* nested = find_table(own.c_str());
      Alternative read;
      if (nested) read_table(*nested, name(own), read);
      if (own != chosen) return;
      require(nested, key, own + " needs a table [" + name(own) + "]");
      value = std::move(read);
    };
    (read_alternative(std::type_identity<Alternatives>{}), ...);
  }

  /// Checks a rule between keys; the message refers to the line of `key`, or to the table without
  /// that key.
  void require(bool truth, const char* key, const std::string& message);

  void line(int& number) const { number = line_of(table_); }

  /// Call last: refuses keys that were not read.
  void refuse_unknown_keys();

 private:
  static int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }
  static std::string describe(const toml::node& node);

  template <class T>
  void read_table(const toml::table& nested, const std::string& path, T& value) {
    TomlReader reader(nested, path, finding_);
    visit(reader, value);
    reader.refuse_unknown_keys();
  }

  /// Refuses a key that is valid only in the case `when`.
  void refuse_other_case(const char* key, const char* when);

  std::string name(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  const toml::node* find(const char* key);
  const toml::table* find_table(const char* key);
  std::vector<const toml::table*> find_tables(const char* key, std::size_t least, std::size_t most);

  void read(const toml::node& node, const std::string& key, bool& value);
  void read(const toml::node& node, const std::string& key, std::string& value);
  void read(const toml::node& node, const std::string& key, std::filesystem::path& value);
  void read(const toml::node& node, const std::string& key, NamedFile& value);
  void read(const toml::node& node, const std::string& key, std::vector<std::string>& value);
  void read(const toml::node& node, const std::string& key, Reference& value) {
    read(node, key, value.name);
  }
  void read(const toml::node& node, const std::string& key, double& value, const Range& range);
  template <std::integral T>
  void read(const toml::node& node, const std::string& key, T& value, const Range& range) {
    if (const auto given = read_integer(node, key, range)) value = static_cast<T>(*given);
  }
  std::optional<std::int64_t> read_integer(const toml::node& node, const std::string& key,
                                           const Range& range);

  template <class Rep, class Unit, class Period>
  void read(const toml::node& node, const std::string& key, std::chrono::duration<Rep, Unit>& value,
            const DurationRange<Period>& allowed) {
    using Number = std::chrono::duration<double, Period>;
    double count = Number(value).count();
    read(node, key, count, allowed.range);
    value = std::chrono::duration_cast<std::chrono::duration<Rep, Unit>>(Number(count));
  }

  template <class T>
  void read(const toml::node& node, const std::string& key, std::vector<T>& value,
            const Range& range) {
    const toml::array* list = node.as_array();
    if (!list) {
      finding_.refuse(line_of(node), key, "must be a list of numbers");
      return;
    }
    value.clear();
    for (const toml::node& item : *list) read(item, key, value.emplace_back(), range);
  }
  void read(const toml::node& node, const std::string& key, optics::Vec3& value,
            const Range& range);
  void read(const toml::node& node, const std::string& key, optics::Mat3& value,
            const Range& range);

  template <std::size_t N>
  void read(const toml::node& node, const std::string& key, std::array<double, N>& value,
            const Range& range) {
    const toml::array* list = node.as_array();
    if (!list || list->size() != N) {
      finding_.refuse(line_of(node), key, "must be a list of " + std::to_string(N) + " numbers");
      return;
    }
    for (std::size_t i = 0; i < N; ++i) read((*list)[i], key, value[i], range);
  }

  template <std::size_t N>
  void read(const toml::node& node, const std::string& key,
            std::vector<std::array<double, N>>& value, const Range& range) {
    const toml::array* list = node.as_array();
    if (!list || list->size() > kLongestList) {
      finding_.refuse(line_of(node), key,
                      "must be a list of lists, at most " + std::to_string(kLongestList));
      return;
    }
    value.clear();
    for (const toml::node& item : *list) read(item, key, value.emplace_back(), range);
  }

  template <class T, class... Constraint>
  void read(const toml::node& node, const std::string& key, std::optional<T>& value,
            const Constraint&... constraint) {
    read(node, key, value.emplace(), constraint...);
  }

  static constexpr std::size_t kLongestList = 64;

  const toml::table& table_;
  std::string path_;
  Finding& finding_;
  std::vector<std::string> known_;
};

/// Reads the text of a file, named by `finding`, into the settings that a visit() declares.
template <class Settings>
void read_toml(const std::string& text, Settings& settings, Finding& finding) {
  try {
    const toml::table table = parse_toml(text, finding.file);
    TomlReader reader(table, "", finding);
    visit(reader, settings);
    reader.refuse_unknown_keys();
  } catch (const toml::parse_error& error) {
    finding.refuse(static_cast<int>(error.source().begin.line), "not valid TOML",
                   std::string(error.description()));
  }
}

}  // namespace orbwatch::app::files
