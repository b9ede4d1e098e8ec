// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>

#include "app/model/status/field.h"
#include "app/ports/web/api/record.h"

/// Schemas of records, in the form of OpenAPI 3.0. All reentrant.
namespace orbwatch::app::web {

/// Schema of a code: its numbers with their texts, and with their names if there is a name_of().
template <Enumeration Code>
Json code_schema() {
  Json schema{{"type", "integer"}};
  for (const CodeText& code : code_texts<Code>()) {
    schema["enum"].push_back(code.number);
    if constexpr (requires { name_of(Code{}); }) {
      schema["x-enum-varnames"].push_back(name_of(static_cast<Code>(code.number)));
    }
    schema["x-enum-descriptions"].push_back(code.text);
  }
  return schema;
}

/// Direction of a record: numbers of an answer may be NaN, and are then null.
enum class Sent { ByClient, ByUs };

template <class T, Sent sent>
Json schema_of();

/// Describes a record's members.
template <Sent sent>
class SchemaWriter {
 public:
  template <class T, class... Facts>
  void required(std::string_view name, T& member, const Facts&... facts) {
    add(name, member, facts...);
    required_.push_back(name);
    if constexpr (Coded<T>) required_.push_back(std::string(name) + "_text");
  }
  template <class T, class... Facts>
  void optional(std::string_view name, T& member, const Facts&... facts) {
    Json& schema = add(name, member, facts...);
    if constexpr (sent == Sent::ByClient) {
      // Left out rather than null.
      if constexpr (kIsOptional<T>) schema.erase("nullable");
      RecordWriter usual;
      usual.optional(name, member, facts...);
      Json json = usual.take();
      if (json.contains(std::string(name))) {
        Json& value = json.at(std::string(name));
        const bool is_text = value.is_string() && !value.get_ref<const std::string&>().empty();
        if (value.is_number() || is_text) schema["default"] = value;
      }
    }
  }
  void require(bool /*truth*/, std::string_view /*message*/) {}

  Json take() {
    Json schema{{"type", "object"}, {"properties", std::move(properties_)}};
    schema["additionalProperties"] = false;
    if (!required_.empty()) schema["required"] = std::move(required_);
    return schema;
  }

 private:
  template <class T, class... Facts>
  Json& add(std::string_view name, T& /*member*/, const Facts&... facts) {
    const std::string key(name);
    Json schema = schema_of<T, sent>();
    (add_fact(schema, facts), ...);
    properties_[key] = std::move(schema);
    if constexpr (Coded<T>) {
      properties_[key + "_text"] = {{"type", "string"}, {"description", "The code as text"}};
    }
    return properties_[key];
  }

  /// The first text is the description, the second the unit.
  static void add_fact(Json& schema, std::string_view text) {
    schema[schema.contains("description") ? "x-unit" : "description"] = text;
  }
  /// The range of a list is that of its items.
  static void add_fact(Json& schema, const Range& range) {
    Json& number = schema.contains("items") ? schema["items"] : schema;
    if (range.low > kAnyNumber.low) number["minimum"] = to_json(range.low);
    if (range.high < kAnyNumber.high) number["maximum"] = to_json(range.high);
    if (!range.low_allowed) number["exclusiveMinimum"] = true;
    if (!range.high_allowed) number["exclusiveMaximum"] = true;
  }
  template <class T, std::size_t N>
  static void add_fact(Json& schema, const std::array<Word<T>, N>& words) {
    schema["type"] = "string";
    for (const char* key : {"minimum", "maximum"}) schema.erase(key);
    Json& names = schema["enum"] = Json::array();
    for (const auto& word : words) names.push_back(word.name);
  }

  Json properties_ = Json::object();
  Json required_ = Json::array();
};

/// @name Schemas by type; `type` only selects the overload.
/// @{
inline Json list_schema(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }
inline Json list_schema(Json items, std::size_t size) {
  return {{"type", "array"}, {"items", std::move(items)}, {"minItems", size}, {"maxItems", size}};
}
template <Sent sent>
Json schema_for(std::type_identity<Json> /*type*/) {
  return Json::object();
}
template <Sent sent>
Json schema_for(std::type_identity<bool> /*type*/) {
  return {{"type", "boolean"}};
}
template <Sent sent>
Json schema_for(std::type_identity<double> /*type*/) {
  Json schema{{"type", "number"}};
  if (sent == Sent::ByUs) schema["nullable"] = true;
  return schema;
}
template <Sent sent>
Json schema_for(std::type_identity<std::string> /*type*/) {
  return {{"type", "string"}};
}
template <Sent sent>
Json schema_for(std::type_identity<std::string_view> /*type*/) {
  return {{"type", "string"}};
}
template <Sent sent, std::integral Number>
Json schema_for(std::type_identity<Number> /*type*/) {
  using Limits = std::numeric_limits<Number>;
  Json schema{{"type", "integer"}};
  if (sent == Sent::ByClient || !Limits::is_signed) schema["minimum"] = Limits::min();
  // Larger numbers are not exact in JSON (RFC 8259, 6).
  constexpr double kMostExact = 9007199254740991;
  if (sent == Sent::ByClient) {
    schema["maximum"] = to_json(std::min(static_cast<double>(Limits::max()), kMostExact));
  }
  return schema;
}
template <Sent sent, class Code>
requires std::is_enum_v<Code> Json schema_for(std::type_identity<Code> /*type*/) {
  if constexpr (Coded<Code>) {
    return code_schema<Code>();
  } else {
    return Json::object();  // a word, described by its array
  }
}
template <Sent sent>
Json schema_for(std::type_identity<optics::Vec2> /*type*/) {
  return list_schema(schema_of<double, Sent::ByClient>(), 2);
}
template <Sent sent>
Json schema_for(std::type_identity<optics::Vec3> /*type*/) {
  return list_schema(schema_of<double, Sent::ByClient>(), 3);
}
template <Sent sent, class T>
Json schema_for(std::type_identity<std::optional<T>> /*type*/) {
  Json schema = schema_of<T, sent>();
  schema["nullable"] = true;
  return schema;
}
template <Sent sent, class T>
Json schema_for(std::type_identity<std::vector<T>> /*type*/) {
  return list_schema(schema_of<T, sent>());
}
template <Sent sent, class T, std::size_t N>
Json schema_for(std::type_identity<std::array<T, N>> /*type*/) {
  return list_schema(schema_of<T, sent>(), N);
}
template <Sent sent, class T>
Json schema_for(std::type_identity<std::map<std::string, T>> /*type*/) {
  return {{"type", "object"}, {"additionalProperties", schema_of<T, sent>()}};
}
template <Sent sent, class T>
Json schema_for(std::type_identity<std::vector<std::pair<std::string, T>>> /*type*/) {
  return schema_of<std::map<std::string, T>, sent>();
}
template <Sent sent, class Record>
requires requires(Record& record, SchemaWriter<sent>& v) { visit(v, record); }
Json schema_for(std::type_identity<Record> /*type*/) {
  Record record{};
  SchemaWriter<sent> writer;
  visit(writer, record);
  return writer.take();
}
/// @}

/// Schema of a value.
template <class T, Sent sent>
Json schema_of() {
  return schema_for<sent>(std::type_identity<T>{});
}

/// Record in the body of a request. Errors: those of parse_body() and record_of().
template <class Body>
Result<Body> parse_record(std::string_view body) {
  return parse_body(body, schema_of<Body, Sent::ByClient>()).and_then(record_of<Body>);
}

}  // namespace orbwatch::app::web
