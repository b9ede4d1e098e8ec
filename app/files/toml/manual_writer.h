// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "app/files/toml/finding.h"
#include "proc/optics/vec.h"
#include "proc/settings/settings.h"

namespace orbwatch::app::files {

/// Visitor that writes a file's manual in Markdown: a table of keys per TOML table.
class ManualWriter {
 public:
  ManualWriter(std::string path, std::string heading)
      : path_(std::move(path)), heading_(std::move(heading)) {}

  template <class T, class Constraint>
  void required(const char* key, T&, const Constraint& constraint, const char* text) {
    row(key, allowed(constraint) + list_note(static_cast<T*>(nullptr)), "required", text);
  }
  template <class T>
  void required(const char* key, T&, const char* text) {
    row(key, kind(static_cast<T*>(nullptr)), "required", text);
  }
  template <class T, class Constraint>
  void optional(const char* key, T& value, const Constraint& constraint, const char* text) {
    row(key, allowed(constraint) + list_note(static_cast<T*>(nullptr)),
        default_of(value, constraint), text);
  }
  template <class T>
  void optional(const char* key, T& value, const char* text) {
    row(key, kind(static_cast<T*>(nullptr)), show(value), text);
  }

  template <class T>
  void table(const char* key, T& value, const char* text) {
    nested_ += section(key, value, "[" + full(key) + "]", text);
  }
  template <class T>
  void table(const char* key, std::optional<T>&, const char* text) {
    nested_ += section(key, T(), "[" + full(key) + "]", text);
  }
  template <class T>
  void tables(const char* key, std::vector<T>&, std::size_t least, std::size_t most,
              const char* text) {
    nested_ += section(
        key, T(), "[[" + full(key) + "]]",
        std::string(text) + " (" + std::to_string(least) + " to " + std::to_string(most) + ")");
  }
  template <class... Alternatives>
  void one_of(const char* key, std::variant<Alternatives...>&, const char* text) {
    constexpr std::array<std::string_view, sizeof...(Alternatives)> kNames{Alternatives::kName...};
    row(key, allowed(kNames), "required", text);
    const std::string purpose = std::string("Settings for ") + key + " ";
    const auto alternative = [&](const std::string& name, auto value) {
      nested_ += section(name, value, "[" + full(name) + "]", purpose + name);
    };
    (alternative(std::string(Alternatives::kName), Alternatives{}), ...);
  }
  template <class T, class Constraint>
  void required_if(bool /*applies*/, const char* when, const char* key, T&,
                   const Constraint& constraint, const char* text) {
    row(key, allowed(constraint) + list_note(static_cast<T*>(nullptr)),
        std::string("required for ") + when, text);
  }
  template <class T, class... Rest>
  void optional_if(bool /*applies*/, const char* /*when*/, const char* key, T& value,
                   const Rest&... rest) {
    optional(key, value, rest...);
  }
  void require(bool, const char*, const std::string&) {}
  void line(int&) {}

  /// Returns the rows of this table, then its nested tables.
  std::string finish() {
    std::string text;
    if (!rows_.empty()) {
      text =
          heading_ + "\n| key | allowed | default | meaning |\n|---|---|---|---|\n" + rows_ + "\n";
    } else {
      text = heading_;
    }
    return text + nested_;
  }

 private:
  std::string full(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

  template <class T>
  std::string section(const std::string& key, T value, const std::string& title,
                      const std::string& text) {
    ManualWriter writer(full(key), "## `" + title + "`\n" + text + ".\n");
    visit(writer, value);
    return writer.finish();
  }

  void row(const std::string& key, const std::string& allowed, const std::string& standard,
           const std::string& text) {
    rows_ += "| `" + key + "` | " + allowed + " | " + standard + " | " + text + " |\n";
  }

  static std::string allowed(const Range& range) { return range.text(); }
  template <class Period>
  static std::string allowed(const DurationRange<Period>& duration) {
    return duration.range.text();
  }
  template <class T, std::size_t N>
  static std::string allowed(const std::array<Word<T>, N>& words) {
    std::string text;
    for (const auto& word : words)
      text += (text.empty() ? "`" : ", `") + std::string(word.name) + "`";
    return text;
  }
  template <std::size_t N>
  static std::string allowed(const std::array<std::string_view, N>& words) {
    std::string text;
    for (const auto& word : words) text += (text.empty() ? "`" : ", `") + std::string(word) + "`";
    return text;
  }

  static std::string kind(const bool*) { return "true or false"; }
  static std::string kind(const std::string*) { return "a string"; }
  static std::string kind(const Reference*) { return "a string"; }
  static std::string kind(const std::filesystem::path*) { return "a path"; }
  static std::string kind(const NamedFile*) { return "a path"; }
  static std::string kind(const std::vector<std::string>*) { return "a list of strings"; }
  template <class T>
  static std::string kind(const std::optional<T>*) {
    return kind(static_cast<T*>(nullptr));
  }

  static std::string list_note(const void*) { return ""; }
  template <std::size_t N>
  static std::string list_note(const std::array<double, N>*) {
    return ", list of " + std::to_string(N);
  }
  template <class T>
  static std::string list_note(const std::vector<T>*) {
    return ", list";
  }
  template <std::size_t N>
  static std::string list_note(const std::vector<std::array<double, N>>*) {
    return ", list of lists of " + std::to_string(N);
  }
  static std::string list_note(const optics::Vec3*) { return ", list of 3"; }
  static std::string list_note(const optics::Mat3*) { return ", list of 9"; }
  template <class T>
  static std::string list_note(const std::optional<T>*) {
    return list_note(static_cast<T*>(nullptr));
  }

  template <class T, std::size_t N>
  static std::string default_of(const T& value, const std::array<Word<T>, N>& words) {
    for (const auto& word : words) {
      if (word.value == value) return "`" + std::string(word.name) + "`";
    }
    return "";
  }
  template <class T>
  static std::string default_of(const T& value, const Range& range) {
    if constexpr (std::is_arithmetic_v<T>) {
      if (!range.contains(static_cast<double>(value))) return "none";
    }
    return show(value);
  }
  template <class Rep, class Unit, class Period>
  static std::string default_of(const std::chrono::duration<Rep, Unit>& value,
                                const DurationRange<Period>& allowed) {
    return default_of(std::chrono::duration<double, Period>(value).count(), allowed.range);
  }
  template <class T, class Period>
  static std::string default_of(const std::optional<T>& value,
                                const DurationRange<Period>& allowed) {
    return value ? default_of(*value, allowed) : "none";
  }
  template <std::size_t N>
  static std::string default_of(const std::string& value, const std::array<std::string_view, N>&) {
    return show(value);
  }

  static std::string show(bool value) { return value ? "true" : "false"; }
  static std::string show(const std::string& value) {
    return value.empty() ? "none" : "`" + value + "`";
  }
  static std::string show(const Reference& value) { return show(value.name); }
  static std::string show(const std::filesystem::path&) { return ""; }
  template <std::integral T>
  static std::string show(T value) {
    return std::to_string(value);
  }
  static std::string show(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
  }
  template <class T>
  static std::string show(const std::vector<T>& values) {
    std::string text;
    for (const T& value : values) text += (text.empty() ? "" : ", ") + show(value);
    return "[" + text + "]";
  }
  template <class T>
  static std::string show(const std::optional<T>&) {
    return "none";
  }
  template <std::size_t N>
  static std::string show(const std::array<double, N>& values) {
    return show(std::vector<double>(values.begin(), values.end()));
  }
  static std::string show(const optics::Vec3& v) { return show(std::array{v.x, v.y, v.z}); }

  std::string path_;
  std::string heading_;
  std::string rows_;
  std::string nested_;
};

/// Manual of a file whose keys visit() declares for `settings`, after an introduction.
template <class Settings>
std::string manual(const std::string& introduction, Settings& settings) {
  ManualWriter writer("", introduction);
  visit(writer, settings);
  std::string text = writer.finish();
  while (text.ends_with("\n\n")) text.pop_back();
  return text;
}

}  // namespace orbwatch::app::files
