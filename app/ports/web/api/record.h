// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/model/status/json.h"
#include "app/ports/web/api/json_form.h"
#include "proc/optics/vec.h"
#include "proc/settings/settings.h"

/// Records: structs that are sent and received as JSON objects. Like settings, a record declares
/// each member once, in a visit() beside it, from which it is read, written and described:
///
///   struct Limit {
///     std::string signal;
///     std::optional<double> value;
///     int seconds = 60;
///   };
///   template <class Visitor>
///   void visit(Visitor& v, Limit& limit) {
///     v.required("signal", limit.signal, "Name of the signal");
///     v.required("value", limit.value, "In the signal's unit; null: none");
///     v.optional("seconds", limit.seconds, Range::between(10, 3600), "Time of the trial", "s");
///   }
///
/// | call | for |
/// |---|---|
/// | `required(name, member, text, unit)` | a member that must be sent, and is always written |
/// | `required(name, member, Range, text, unit)` | the same for a number, or a list, with limits |
/// | `required(name, member, words, text)` | the same for a word of an array of Word |
/// | `optional(...)` | the same with the member's default; an empty std::optional is not written |
/// | `require(truth, message)` | a rule between members of a received record |
///
/// Members may be bool, numbers, texts, enumerations with operator_text() (sent as number, and text
/// in "<name>_text"), optics::Vec2 and Vec3, records, Json of any form, and std::optional (null),
/// vector, array and map<std::string, ...> of these, or a vector of pairs of name and value for an
/// object in this order. NaN is sent as null. All reentrant.
namespace orbwatch::app::web {

/// A record without members: a request without arguments, or an answer without values.
struct Nothing {};
template <class Visitor>
void visit(Visitor& /*v*/, Nothing& /*nothing*/) {}

template <class T>
concept Coded = std::is_enum_v<T> && requires(T code) {
  operator_text(code);
};

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;

class RecordReader;
class RecordWriter;

/// @name The JSON form of a value.
/// @{
inline Json json_of(bool flag) { return flag; }
inline Json json_of(double number) { return to_json(number); }
inline Json json_of(const std::string& text) { return text; }
inline Json json_of(std::string_view text) { return text; }
inline Json json_of(const char* text) { return text; }
template <std::same_as<Json> Any>
Json json_of(Any& json) {
  return json;
}
inline Json json_of(const optics::Vec2& v) { return {v.u, v.v}; }
inline Json json_of(const optics::Vec3& v) { return {v.x, v.y, v.z}; }
template <std::integral Number>
Json json_of(Number number) {
  return number;
}
template <Coded Code>
Json json_of(Code code) {
  return static_cast<int>(code);
}
template <class T>
Json json_of(std::optional<T>& value);
template <class T>
Json json_of(std::vector<T>& list);
template <class T, std::size_t N>
Json json_of(std::array<T, N>& list);
template <class T>
Json json_of(std::map<std::string, T>& members);
template <class T>
Json json_of(std::vector<std::pair<std::string, T>>& members);
template <class Record>
requires requires(Record& record, RecordWriter& v) { visit(v, record); }
Json json_of(Record& record);
/// @}

/// Writes a record.
class RecordWriter {
 public:
  template <class T, class... Facts>
  void required(std::string_view name, T& member, const Facts&... facts) {
    put(name, member, facts...);
  }
  template <class T, class... Facts>
  void optional(std::string_view name, T& member, const Facts&... facts) {
    if constexpr (kIsOptional<T>) {
      if (!member) return;
    }
    put(name, member, facts...);
  }
  void require(bool /*truth*/, std::string_view /*message*/) {}

  Json take() { return std::move(object_); }

 private:
  template <class T, class... Facts>
  void put(std::string_view name, T& member, const Facts&... facts) {
    object_[std::string(name)] = value_of(member, facts...);
    if constexpr (Coded<T>) object_[std::string(name) + "_text"] = operator_text(member);
  }
  template <class T, std::size_t N, class... Facts>
  static Json value_of(T& member, const std::array<Word<T>, N>& words, const Facts&... /*facts*/) {
    return word_for(words, member);
  }
  template <class T, std::size_t N, class... Facts>
  static Json value_of(std::optional<T>& member, const std::array<Word<T>, N>& words,
                       const Facts&... /*facts*/) {
    return member ? Json(word_for(words, *member)) : Json();
  }
  template <class T, class... Facts>
  static Json value_of(T& member, const Facts&... /*facts*/) {
    return json_of(member);
  }

  Json object_ = Json::object();
};

/// Reads a record from an object that check_form() accepts.
class RecordReader {
 public:
  /// `problem` receives the first broken rule; both outlive the reader.
  RecordReader(const Json& object, std::string& problem) : object_(object), problem_(problem) {}

  template <class T, class... Facts>
  void required(std::string_view name, T& member, const Facts&... facts) {
    const auto found = object_.find(std::string(name));
    if (found != object_.end()) read(*found, member, facts...);
  }
  template <class T, class... Facts>
  void optional(std::string_view name, T& member, const Facts&... facts) {
    required(name, member, facts...);
  }
  void require(bool truth, std::string_view message) {
    if (!truth && problem_.empty()) problem_ = message;
  }

 private:
  template <class T, std::size_t N, class... Facts>
  void read(const Json& sent, T& member, const std::array<Word<T>, N>& words,
            const Facts&... /*facts*/) {
    if (const T* word = find_word(words, sent.get_ref<const std::string&>())) member = *word;
  }
  template <class T, std::size_t N, class... Facts>
  void read(const Json& sent, std::optional<T>& member, const std::array<Word<T>, N>& words,
            const Facts&... /*facts*/) {
    if (!sent.is_null()) read(sent, member.emplace(), words);
  }
  template <class T, class... Facts>
  void read(const Json& sent, T& member, const Facts&... /*facts*/) {
    read_value(sent, member);
  }

  static void read_value(const Json& sent, bool& flag) { flag = sent.get<bool>(); }
  static void read_value(const Json& sent, std::string& text) { text = sent.get<std::string>(); }
  static void read_value(const Json& sent, double& number) { number = sent.get<double>(); }
  /// A whole number may be written with a fraction of zero.
  template <std::integral Number>
  static void read_value(const Json& sent, Number& number) {
    number = sent.is_number_float() ? static_cast<Number>(sent.get<double>()) : sent.get<Number>();
  }
  template <class T>
  void read_value(const Json& sent, std::optional<T>& value) {
    if (!sent.is_null()) read_value(sent, value.emplace());
  }
  template <class T>
  void read_value(const Json& sent, std::vector<T>& list) {
    for (const Json& one : sent) read_value(one, list.emplace_back());
  }
  template <class T, std::size_t N>
  void read_value(const Json& sent, std::array<T, N>& list) {
    for (std::size_t i = 0; i < N; ++i) read_value(sent[i], list[i]);
  }
  template <class T>
  void read_value(const Json& sent, std::map<std::string, T>& members) {
    for (const auto& [name, one] : sent.items()) read_value(one, members[name]);
  }
  template <class Record>
  requires requires(Record& record, RecordReader& v) { visit(v, record); }
  void read_value(const Json& sent, Record& record) {
    RecordReader reader(sent, problem_);
    visit(reader, record);
  }

  const Json& object_;
  std::string& problem_;
};

template <class T>
Json json_of(std::optional<T>& value) {
  return value ? json_of(*value) : Json();
}
template <class T>
Json json_of(std::vector<T>& list) {
  Json json = Json::array();
  for (auto&& one : list) json.push_back(json_of(one));
  return json;
}
template <class T, std::size_t N>
Json json_of(std::array<T, N>& list) {
  Json json = Json::array();
  for (T& one : list) json.push_back(json_of(one));
  return json;
}
template <class T>
Json json_of(std::map<std::string, T>& members) {
  Json json = Json::object();
  for (auto& [name, one] : members) json[name] = json_of(one);
  return json;
}
template <class T>
Json json_of(std::vector<std::pair<std::string, T>>& members) {
  Json json = Json::object();
  for (auto& [name, one] : members) json[name] = json_of(one);
  return json;
}
template <class Record>
requires requires(Record& record, RecordWriter& v) { visit(v, record); }
Json json_of(Record& record) {
  RecordWriter writer;
  visit(writer, record);
  return writer.take();
}

/// Reads a record from a checked object. Error: a rule between members that is broken.
template <class Record>
Result<Record> record_of(const Json& object) {
  Record record;
  std::string problem;
  RecordReader reader(object, problem);
  visit(reader, record);
  if (!problem.empty()) return fail(problem);
  return record;
}

}  // namespace orbwatch::app::web
