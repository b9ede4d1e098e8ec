// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/api/json_form.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "app/model/status/json.h"

namespace orbwatch::app::web {
namespace {

const std::string kNoText;

const std::string& text_in(const Json& schema, const char* key) {
  const auto found = schema.find(key);
  return found == schema.end() ? kNoText : found->get_ref<const std::string&>();
}

/// Numbers that a schema allows.
Range range_of(const Json& schema) {
  Range range;
  if (const auto low = schema.find("minimum"); low != schema.end()) range.low = low->get<double>();
  if (const auto high = schema.find("maximum"); high != schema.end()) {
    range.high = high->get<double>();
  }
  range.low_allowed = !schema.value("exclusiveMinimum", false);
  range.high_allowed = !schema.value("exclusiveMaximum", false);
  return range;
}

/// Text such as "a whole number, 0 to 1"; a unit follows the numbers.
std::string number_form(const Json& schema) {
  const std::string range = range_of(schema).text();
  const std::string& unit = text_in(schema, "x-unit");
  std::string text = range;
  if (text_in(schema, "type") == "integer") {
    text = "a whole number" + (range == kAnyNumber.text() ? "" : ", " + range);
  }
  return text + (unit.empty() ? "" : " " + unit);
}

std::string object_form(const Json& schema) {
  const auto members = schema.find("properties");
  if (members == schema.end()) {
    return R"({"NAME": )" + form_text(schema.at("additionalProperties")) + ", ...}";
  }
  std::string text = "{";
  for (const auto& [name, member] : members->items()) {
    text += (text.size() == 1 ? "\"" : ", \"") + name + "\": " + form_text(member) +
            (is_required(schema, name) ? "" : " (optional)");
  }
  return text + "}";
}

std::string list_form(const Json& schema) {
  const std::string items = form_text(schema.at("items"));
  const auto least = schema.find("minItems");
  if (least == schema.end()) return "[" + items + ", ...]";
  std::string text = "[";
  for (std::size_t n = 0; n < least->get<std::size_t>(); ++n) text += (n == 0 ? "" : ", ") + items;
  return text + "]";
}

/// Returns whether a number is allowed; integral values may be written with a fraction of zero.
bool allows(const Json& schema, double value, bool is_integer) {
  const bool is_whole = is_integer || value == std::floor(value);
  return (is_whole || text_in(schema, "type") != "integer") && range_of(schema).contains(value);
}

tl::unexpected<Error> refused_form(const Json& value, const Json& schema, const std::string& name) {
  const bool is_number = value.is_number() && text_in(schema, "type") != "string";
  const std::string is = is_number ? " is " + value.dump() + "; it" : "";
  return fail(name + is + " must be " + form_text(schema));
}

Result<> check_members(const Json& object, const Json& schema, const std::string& name) {
  const std::string prefix = name.empty() ? "" : name + ".";
  const auto members = schema.find("properties");
  const auto others = schema.find("additionalProperties");
  const bool is_open = others != schema.end() && others->is_object();
  if (members != schema.end()) {
    for (const auto& [member, form] : members->items()) {
      if (!object.contains(member) && is_required(schema, member)) {
        return fail(prefix + member + " is missing; it must be " + form_text(form));
      }
    }
  }
  for (const auto& [member, value] : object.items()) {
    const bool is_known = members != schema.end() && members->contains(member);
    if (!is_known && !is_open) {
      // The name is not quoted, because it may be a password.
      return fail((name.empty() ? "the body" : name) + " has an unknown member");
    }
    const Json& form = is_known ? members->at(member) : *others;
    if (auto checked = check_form(value, form, prefix + member); !checked) return checked;
  }
  return {};
}

Result<> check_items(const Json& list, const Json& schema, const std::string& name) {
  const auto least = schema.find("minItems"), most = schema.find("maxItems");
  if ((least != schema.end() && list.size() < least->get<std::size_t>()) ||
      (most != schema.end() && list.size() > most->get<std::size_t>())) {
    return refused_form(list, schema, name);
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    auto checked = check_form(list[i], schema.at("items"), name + "[" + std::to_string(i) + "]");
    if (!checked) return checked;
  }
  return {};
}

}  // namespace

Json schema_of(const CommandInfo& info) {
  Json properties = Json::object(), required = Json::array();
  for (std::size_t i = 0; i < info.argument_count(); ++i) {
    const ArgumentInfo& argument = info.arguments[i];
    Json& member = properties[std::string(argument.name)];
    member = {{"type", argument.scale == 1 ? "integer" : "number"},
              {"minimum", to_json(argument.minimum)},
              {"maximum", to_json(argument.maximum)},
              {"description", argument.description}};
    if (!argument.unit.empty()) member["x-unit"] = argument.unit;
    required.push_back(argument.name);
  }
  Json schema{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

bool is_required(const Json& schema, const std::string& member) {
  const auto required = schema.find("required");
  return required != schema.end() &&
         std::find(required->begin(), required->end(), member) != required->end();
}

std::string form_text(const Json& schema) {
  const std::string null = schema.value("nullable", false) ? " or null" : "";
  if (const auto words = schema.find("enum"); words != schema.end()) {
    std::string text;
    for (const Json& word : *words) {
      text += text.empty() ? "one of " : ", ";
      text += word.is_string() ? word.get_ref<const std::string&>() : word.dump();
    }
    return text + null;
  }
  const std::string& type = text_in(schema, "type");
  if (type == "object") return object_form(schema) + null;
  if (type == "array") return list_form(schema) + null;
  if (type == "boolean") return "true or false" + null;
  if (type == "string") return "a string" + null;
  if (type.empty()) return "any value";
  return number_form(schema) + null;
}

Result<> check_form(const Json& value, const Json& schema, const std::string& name) {
  if (value.is_null() && schema.value("nullable", false)) return {};
  const std::string& type = text_in(schema, "type");
  const bool is_right =
      type.empty()       ? true
      : type == "object" ? value.is_object()
      : type == "array"  ? value.is_array()
      : type == "string" ? value.is_string()
      : type == "boolean"
          ? value.is_boolean()
          : value.is_number() && allows(schema, value.get<double>(), value.is_number_integer());
  const auto words = schema.find("enum");
  const bool is_word =
      words == schema.end() || std::find(words->begin(), words->end(), value) != words->end();
  if (!is_right || !is_word) {
    return refused_form(value, schema, name.empty() ? "the body" : name);
  }
  if (type == "object") return check_members(value, schema, name);
  if (type == "array") return check_items(value, schema, name);
  return {};
}

Result<Json> parse_body(std::string_view body, const Json& schema) {
  const auto refused = [&schema](const std::string& what) {
    return fail(what + "; the body must be " + form_text(schema));
  };
  Json sent = Json::parse(body.empty() ? "{}" : body, nullptr, false);
  if (!sent.is_object()) return refused("the body is not a JSON object");
  const auto checked = check_form(sent, schema, "");
  if (!checked) return refused(checked.error().message);
  return sent;
}

std::string json_text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace orbwatch::app::web
