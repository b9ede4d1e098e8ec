// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "app/model/command/command.h"
#include "proc/image/result.h"

/// Schemas in the form of OpenAPI 3.0, and the check of values against them: a value that is not
/// described is never read. All reentrant.
namespace orbwatch::app::web {

using Json = nlohmann::ordered_json;

/// Schema of a command's arguments: an object with a number for each, in its unit.
Json schema_of(const CommandInfo& info);

/// Returns whether an object of this schema must have this member.
bool is_required(const Json& schema, const std::string& member);

/// The values that a schema allows: "-180 to 180 deg", "a whole number, 0 to 1", "a string",
/// R"({"user": a string, "role": one of viewer, operator (optional)})".
std::string form_text(const Json& schema);

/// Checks a value sent by a client. `name` is its name in messages, "the body" or
/// "limits[0].value". Error: "yaw is 200; it must be -180 to 180 deg". Quotes only a number where
/// one is expected: anything else may be a secret, or nested so deeply that writing it would crash
/// the process.
Result<> check_form(const Json& value, const Json& schema, const std::string& name);

/// The body of a request, checked: a JSON object; an empty body means no members. Error: the fault
/// and the whole form of the body.
Result<Json> parse_body(std::string_view body, const Json& schema);

/// Writes JSON; bytes that are not UTF-8 are replaced.
std::string json_text(const Json& json);

}  // namespace orbwatch::app::web
