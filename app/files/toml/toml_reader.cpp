// SPDX-License-Identifier: Apache-2.0
#include "app/files/toml/toml_reader.h"

#include <algorithm>
#include <sstream>

namespace orbwatch::app::files {

void TomlReader::require(bool truth, const char* key, const std::string& message) {
  if (truth) return;
  const toml::node* node = table_.get(key);
  finding_.refuse(line_of(node ? *node : table_), name(key), message);
}

void TomlReader::refuse_unknown_keys() {
  for (const auto& [key, node] : table_) {
    const std::string_view given = key.str();
    if (std::find(known_.begin(), known_.end(), given) != known_.end()) continue;
    std::string allowed;
    for (const auto& known : known_) allowed += (allowed.empty() ? "" : ", ") + known;
    finding_.refuse_unknown(line_of(node), name(std::string(given)),
                            "is not a key; there are: " + allowed);
  }
}

void TomlReader::refuse_other_case(const char* key, const char* when) {
  if (const toml::node* node = find(key)) {
    finding_.refuse(line_of(*node), name(key), std::string("is only for ") + when);
  }
}

std::string TomlReader::describe(const toml::node& node) {
  std::ostringstream text;
  node.visit([&text](const auto& value) { text << value; });
  const std::string whole = text.str();
  return whole.size() <= 40 ? whole : whole.substr(0, 40) + "...";
}

const toml::node* TomlReader::find(const char* key) {
  known_.emplace_back(key);
  return table_.get(key);
}

const toml::table* TomlReader::find_table(const char* key) {
  const toml::node* node = find(key);
  if (!node) return nullptr;
  if (!node->is_table())
    finding_.refuse(line_of(*node), name(key), "must be a table: [" + name(key) + "]");
  return node->as_table();
}

std::vector<const toml::table*> TomlReader::find_tables(const char* key, std::size_t least,
                                                        std::size_t most) {
  std::vector<const toml::table*> tables;
  const toml::node* node = find(key);
  const toml::array* list = node ? node->as_array() : nullptr;
  const bool right = list && std::all_of(list->begin(), list->end(),
                                         [](const toml::node& n) { return n.is_table(); });
  if (node && !right) {
    finding_.refuse(line_of(*node), name(key), "must be a list of tables: [[" + name(key) + "]]");
    return tables;
  }
  const std::size_t count = list ? list->size() : 0;
  if (count < least || count > most) {
    finding_.refuse(line_of(node ? *node : table_), name(key),
                    std::to_string(count) + " are given; " + std::to_string(least) + " to " +
                        std::to_string(most) + " are allowed");
    return tables;
  }
  for (std::size_t i = 0; i < count; ++i) tables.push_back((*list)[i].as_table());
  return tables;
}

void TomlReader::read(const toml::node& node, const std::string& key, bool& value) {
  if (const auto* given = node.as_boolean()) {
    value = given->get();
  } else {
    finding_.refuse(line_of(node), key,
                    describe(node) + " is not allowed; it must be true or false");
  }
}

void TomlReader::read(const toml::node& node, const std::string& key, std::string& value) {
  if (const auto* given = node.as_string()) {
    value = given->get();
  } else {
    finding_.refuse(line_of(node), key, describe(node) + " is not allowed; it must be a string");
  }
}

void TomlReader::read(const toml::node& node, const std::string& key,
                      std::filesystem::path& value) {
  std::string text;
  read(node, key, text);
  // An empty text names no file; joined, it would name the folder.
  value = text.empty() ? std::filesystem::path() : finding_.folder / text;
}

void TomlReader::read(const toml::node& node, const std::string& key, NamedFile& value) {
  read(node, key, value.path);
  value.line = line_of(node);
  if (value.path.empty()) finding_.refuse(value.line, key, "is empty; it must name a file");
}

void TomlReader::read(const toml::node& node, const std::string& key,
                      std::vector<std::string>& value) {
  const toml::array* list = node.as_array();
  if (!list) {
    finding_.refuse(line_of(node), key, "must be a list of strings");
    return;
  }
  value.clear();
  for (const toml::node& item : *list) read(item, key, value.emplace_back());
}

void TomlReader::read(const toml::node& node, const std::string& key, double& value,
                      const Range& range) {
  const auto given = node.is_number() ? node.value<double>() : std::nullopt;
  if (given && range.contains(*given)) {
    value = *given;
  } else {
    finding_.refuse(line_of(node), key,
                    describe(node) + " is not allowed; it must be a number, " + range.text());
  }
}

std::optional<std::int64_t> TomlReader::read_integer(const toml::node& node, const std::string& key,
                                                     const Range& range) {
  const auto* given = node.as_integer();
  if (given && range.contains(static_cast<double>(given->get()))) return given->get();
  finding_.refuse(line_of(node), key,
                  describe(node) + " is not allowed; it must be a whole number, " + range.text());
  return std::nullopt;
}

void TomlReader::read(const toml::node& node, const std::string& key, optics::Vec3& value,
                      const Range& range) {
  std::array<double, 3> n{};
  read(node, key, n, range);
  value = {n[0], n[1], n[2]};
}

void TomlReader::read(const toml::node& node, const std::string& key, optics::Mat3& value,
                      const Range& range) {
  std::array<double, 9> n{};
  read(node, key, n, range);
  value = {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}};
}

}  // namespace orbwatch::app::files
