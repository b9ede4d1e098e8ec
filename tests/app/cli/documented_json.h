// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <string>

namespace orbwatch::tests {

/// Checks that every key of the document, at any depth, is a word of the help.
inline void expect_documented(const nlohmann::json& json, const std::string& help) {
  for (const auto& [key, value] : json.items()) {
    if (json.is_object()) {
      EXPECT_TRUE(std::regex_search(help, std::regex("\\b" + key + "\\b")))
          << "not in --help: " << key;
    }
    if (value.is_structured()) expect_documented(value, help);
  }
}

/// Parses the document that a program printed; a failure when there is none.
inline nlohmann::json parsed(const std::string& text) {
  auto json = nlohmann::json::parse(text, nullptr, false);
  EXPECT_FALSE(json.is_discarded()) << text;
  return json;
}

}  // namespace orbwatch::tests
