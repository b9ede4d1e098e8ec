#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace orbwatch::app {

/// A value as JSON (RFC 8259), whatever it is: of a text, what is not UTF-8 becomes U+FFFD; a
/// number that is not finite, and nothing, become null. Reentrant, as all of this file.
std::string json_value(std::string_view text);
std::string json_value(double number);
template <std::integral Number>
std::string json_value(Number number) {
  if constexpr (std::is_same_v<Number, bool>)
    return number ? "true" : "false";
  else
    return std::to_string(number);
}
template <class T>
std::string json_value(const std::optional<T>& value) {
  return value ? json_value(*value) : "null";
}
template <class T>
std::string json_value(const std::vector<T>& values) {
  std::string list = "[";
  for (const T& value : values) {
    if (list.size() > 1) list += ", ";
    list += json_value(value);
  }
  return list + "]";
}

enum class JsonLayout {
  OneLine,      ///< for streams, a document per line
  EntryPerLine  ///< each entry of a list on a line of its own
};

/// Writes one object. As a visitor it is handed to the declaration of what the object holds.
class JsonObject {
 public:
  explicit JsonObject(JsonLayout layout, std::string indent = "")
      : layout_(layout), indent_(std::move(indent)) {}

  template <class T>
  void field(std::string_view name, const T& value) {
    add(name, json_value(value));
  }
  /// JSON says units in the name or not at all.
  void field(std::string_view name, double value, std::string_view /*unit*/) { field(name, value); }
  /// Both what programs and what people compare.
  void code(std::string_view name, int number, std::string_view text) {
    field(name, number);
    field(std::string(name) + "_text", text);
  }

  /// `fill(object)` writes its members.
  template <class Fill>
  void object(std::string_view name, const Fill& fill) {
    JsonObject object(layout_, indent_);
    fill(object);
    add(name, object.text());
  }

  /// `fill(object, index)` writes one entry.
  template <class Fill>
  void list(std::string_view name, std::size_t count, const Fill& fill) {
    const bool lines = layout_ == JsonLayout::EntryPerLine;
    const std::string deeper = lines ? indent_ + "  " : "";
    std::string objects;
    for (std::size_t i = 0; i < count; ++i) {
      JsonObject object(layout_, deeper);
      fill(object, i);
      if (i > 0) objects += lines ? "," : ", ";
      objects += (lines ? "\n" : "") + deeper + object.text();
    }
    add(name, "[" + objects + "]");
  }

  /// Of entries that have a visit() of their own.
  template <class Entry>
  void list(std::string_view name, const std::vector<Entry>& entries) {
    list(name, entries.size(),
         [&entries](JsonObject& object, std::size_t i) { visit(object, entries[i]); });
  }

  std::string text() const { return "{" + members_ + "}"; }

 private:
  void add(std::string_view name, const std::string& value) {
    if (!members_.empty()) members_ += ", ";
    members_ += json_value(name) + ": " + value;
  }

  JsonLayout layout_;
  std::string indent_;
  std::string members_;
};

/// A value that has a visit() of its own, as one document without a line feed at its end.
template <class Value>
std::string json_document(const Value& value, JsonLayout layout) {
  JsonObject object(layout);
  visit(object, value);
  return object.text();
}

}  // namespace orbwatch::app
