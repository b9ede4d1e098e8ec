// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "app/files/recipe/recipe_file.h"
#include "app/files/resolve.h"
#include "app/files/rig/camera_calibration.h"
#include "app/files/rig/rig_file.h"
#include "app/files/toml/toml_edit.h"

/// Texts that are designed to end a process, for every parser of foreign files.
namespace orbwatch::app::files {
namespace {

/// Largest body that HTTP accepts by default, bytes.
constexpr std::size_t kSize = 65536;

std::string repeated(std::string_view part, std::size_t size = kSize) {
  std::string text;
  while (text.size() + part.size() <= size) text += part;
  return text;
}

struct Parser {
  std::string name;
  /// Returns the error's message; empty when the text was accepted.
  std::function<std::string(const std::string& text)> refusal;
};

template <class T>
std::string message(const Result<T>& result) {
  return result ? std::string() : result.error().message;
}

const std::vector<Parser> kParsers = {
    {"Site", [](const std::string& text) { return message(resolve_text(text, "f.toml", ".")); }},
    {"Rig", [](const std::string& text) { return message(parse_rig(text, "f.toml", ".")); }},
    {"Recipe", [](const std::string& text) { return message(parse_recipe(text, "f.toml")); }},
    {"Edit", [](const std::string& text) { return message(TomlEdit::make(text, "f.toml")); }},
    {"Lens", [](const std::string& text) { return message(parse_calibration(text, "f.toml")); }}};

struct Text {
  std::string name;
  std::string text;
};

const std::vector<Text> kTexts = {
    {"DottedKey", repeated("a.") + "a = 1"},
    {"DottedHeader", "[" + repeated("a.") + "a]"},
    {"DottedHeaderOfAList", "[[" + repeated("a.") + "a]]"},
    {"QuotedParts", repeated("\"a\".") + "a = 1"},
    {"SpacedParts", repeated("a . ") + "a = 1"},
    {"PartsBehindStrings", "a = '''x'''''\nb = \"\\\"#\"\nc = 1 # '\n" + repeated("a.") + "a = 1"},
    {"InlineTables", repeated("a={") + "a = 1"},
    {"DottedInlineTables", repeated("a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a={") + "a = 1"},
    {"Brackets", "a = " + repeated("[")},
    {"DottedTablesInLists", repeated("a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a=[{") + "a = 1"},
    {"Braces", repeated("{")},
    {"Blocks", repeated("- ")},
    {"Quotes", repeated("\"")},
    {"Apostrophes", repeated("'")},
    {"Backslashes", "a = \"" + repeated("\\")},
    {"Zeros", std::string(kSize, '\0')}};

class HostileText : public testing::TestWithParam<std::tuple<Parser, Text>> {};

TEST_P(HostileText, IsRefusedInOneShortLine) {
  const auto& [parser, text] = GetParam();
  const std::string refusal = parser.refusal(text.text);
  EXPECT_NE(refusal, "");
  EXPECT_EQ(refusal.find('\n'), std::string::npos) << refusal;
  EXPECT_LT(refusal.size(), 1000U);
}

INSTANTIATE_TEST_SUITE_P(AllParsers, HostileText,
                         testing::Combine(testing::ValuesIn(kParsers), testing::ValuesIn(kTexts)),
                         [](const auto& info) {
                           return std::get<0>(info.param).name + "Of" +
                                  std::get<1>(info.param).name;
                         });

/// The limit is far above hand-written texts, and the message names the line.
TEST(TomlDepth, ATextIsRefusedOnlyAboveTheLimit) {
  const auto of = [](int dots) {
    std::string key = "a";
    for (int n = 0; n < dots; ++n) key += ".a";
    return "# first\n" + key + " = 1\n";
  };
  EXPECT_TRUE(TomlEdit::make(of(kDeepestToml), "f.toml"));
  const auto refused = TomlEdit::make(of(kDeepestToml + 1), "f.toml");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "f.toml:2: keys and brackets are nested deeper than 64");
}

TEST(TomlDepth, DotsOfValuesStringsAndCommentsDoNotCount) {
  std::string numbers = "a = [", dots(1000, '.');
  for (int n = 0; n < 1000; ++n) numbers += "1.5, ";
  numbers += "]\n";
  for (const std::string& text : {numbers, "a = \"" + dots + "\"\n", "a = '" + dots + "'\n",
                                  "# " + dots + "\n", "a = \"\"\"\n" + dots + "\"\"\"\"\"\n",
                                  "a = '''" + dots + "''''\n", "\"" + dots + "\" = 1\n"}) {
    const auto taken = TomlEdit::make(text, "f.toml");
    EXPECT_TRUE(taken) << taken.error().message << " in " << text.substr(0, 40);
  }
}

}  // namespace
}  // namespace orbwatch::app::files
