// SPDX-License-Identifier: Apache-2.0
#include "app/cli/doctor/packet_filter.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace orbwatch::app::cli::doctor {
namespace {

using Json = nlohmann::json;

/// The member; null if the object lacks it, or if the value is not an object.
const Json& member(const Json& value, const char* name) {
  static const Json kNull;
  if (!value.is_object()) return kNull;
  const auto found = value.find(name);
  return found == value.end() ? kNull : *found;
}

std::string text(const Json& value) { return value.is_string() ? value.get<std::string>() : ""; }

bool drops_input(const Json& chain) {
  return text(member(chain, "hook")) == "input" && text(member(chain, "policy")) == "drop";
}

/// True for a word of nft's language. Other text would be unsafe in the proposed command.
bool is_word(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
  });
}

/// Family, table and name; nullopt: they are not words.
std::optional<std::string> name_of(const Json& chain) {
  std::string name;
  for (const char* part : {"family", "table", "name"}) {
    const std::string word = text(member(chain, part));
    if (!is_word(word)) return std::nullopt;
    if (!name.empty()) name += ' ';
    name += word;
  }
  return name;
}

int port_number(const Json& value) {
  if (!value.is_number_unsigned()) return -1;
  const auto number = value.get<std::uint64_t>();
  return number <= 65535 ? static_cast<int>(number) : -1;
}

/// Adds a number, {"range": [a, b]}, or {"set": [those]}.
void add_ports(const Json& value, PortRanges& ports) {
  if (const int port = port_number(value); port >= 0) ports.emplace_back(port, port);
  const Json& range = member(value, "range");
  if (range.is_array() && range.size() == 2) {
    const int first = port_number(range[0]), last = port_number(range[1]);
    if (first >= 0 && last >= first) ports.emplace_back(first, last);
  }
  const Json& set = member(value, "set");
  if (!set.is_array()) return;
  for (const Json& item : set) {
    if (!member(item, "set").is_array()) add_ports(item, ports);  // sets are not nested
  }
}

void add_rule(const Json& rule, PacketFilter& filter) {
  const Json& statements = member(rule, "expr");
  if (!statements.is_array()) return;
  const bool accepts = std::ranges::any_of(statements, [](const Json& statement) {
    return statement.is_object() && (statement.contains("accept") || statement.contains("jump"));
  });
  if (!accepts) return;
  for (const Json& statement : statements) {
    const Json& match = member(statement, "match");
    const Json& payload = member(member(match, "left"), "payload");
    const std::string protocol = text(member(payload, "protocol"));
    if (text(member(payload, "field")) != "dport" || text(member(match, "op")) == "!=") continue;
    const bool both = protocol == "th";  // header of any transport
    if (both || protocol == "tcp") add_ports(member(match, "right"), filter.tcp);
    if (both || protocol == "udp") add_ports(member(match, "right"), filter.udp);
  }
}

}  // namespace

std::optional<PacketFilter> read_packet_filter(const std::string& json) {
  const Json all = Json::parse(json, nullptr, false);
  const Json& objects = member(all, "nftables");
  if (!objects.is_array()) return std::nullopt;
  PacketFilter filter;
  for (const Json& object : objects) {
    const Json& chain = member(object, "chain");
    if (const auto name = name_of(chain); name && drops_input(chain)) {
      filter.closed_chains.push_back(*name);
    }
    add_rule(member(object, "rule"), filter);
  }
  return filter;
}

bool names_port(const PortRanges& ranges, int port) {
  return std::ranges::any_of(
      ranges, [port](const auto& range) { return range.first <= port && port <= range.second; });
}

}  // namespace orbwatch::app::cli::doctor
