// SPDX-License-Identifier: Apache-2.0
#include "app/files/toml_edit.h"

#include <gtest/gtest.h>

namespace orbwatch::app {
namespace {

TomlEdit edit_of(const std::string& text) {
  auto edit = TomlEdit::make(text, "a.toml");
  EXPECT_TRUE(edit) << edit.error().message;
  return std::move(*edit);
}

const std::string kText =
    "# of the machine\n"
    "[first]\n"
    "a = 1   # one\n"
    "b = [1,\n"
    "  2]  # two\n"
    "\n"
    "# about the second\n"
    "[[second]]\n"
    "name = \"Grüße\"\n"
    "[second.inner]\n"
    "c = { d = 1 }\n"
    "[[second]]\n"
    "name = \"other\"";

const toml::table& second(const TomlEdit& edit, std::size_t n) {
  return *edit.root()["second"].as_array()->get(n)->as_table();
}

TEST(TomlEdit, WithoutChangesIsTheText) {
  EXPECT_EQ(edit_of(kText).text(), kText);
  EXPECT_EQ(edit_of("").text(), "");
}

TEST(TomlEdit, SetsValuesAndKeepsTheirComments) {
  TomlEdit edit = edit_of(kText);
  const toml::table& first = *edit.root()["first"].as_table();
  edit.set(first, "b", "[3]");
  edit.set(first, "a", "-1.5");
  const std::string text = edit.text();
  EXPECT_NE(text.find("a = -1.5   # one\nb = [3]  # two\n"), std::string::npos) << text;
}

TEST(TomlEdit, CountsColumnsInCharacters) {
  TomlEdit edit = edit_of("a = [\"Grüße\", 1] # ä\nb = { \"ü\" = 2, c = 3 }\n");
  const toml::table& inner = *edit.root()["b"].as_table();
  edit.set(inner, "c", "4");
  EXPECT_EQ(edit.text(), "a = [\"Grüße\", 1] # ä\nb = { \"ü\" = 2, c = 4 }\n");
}

TEST(TomlEdit, AddsAValueBehindTheTablesLastOne) {
  TomlEdit edit = edit_of(kText);
  edit.set(*edit.root()["first"].as_table(), "c", "3");
  const std::string text = edit.text();
  EXPECT_NE(text.find("  2]  # two\nc = 3\n\n# about the second\n"), std::string::npos) << text;
}

TEST(TomlEdit, AddsLinesWithTheEndsThatTheTextHas) {
  TomlEdit edit = edit_of("[a]\r\nb = 1\r\n# end");
  edit.set(*edit.root()["a"].as_table(), "c", "2");
  EXPECT_EQ(edit.text(), "[a]\r\nb = 1\r\nc = 2\r\n# end");
}

TEST(TomlEdit, ReplacesAPartOfAList) {
  TomlEdit edit = edit_of("a = [[1, 2], # ä\n  [ 3,4 ]] # end\n");
  const toml::node& second = *edit.root()["a"].as_array()->get(1);
  EXPECT_EQ(edit.text_of(second), "[ 3,4 ]");
  edit.replace(second, "[5, 6]");
  EXPECT_EQ(edit.text(), "a = [[1, 2], # ä\n  [5, 6]] # end\n");
}

TEST(TomlEdit, RemovesValuesAndTables) {
  TomlEdit edit = edit_of(kText);
  edit.remove(*edit.root()["first"].as_table(), "b");
  edit.remove(second(edit, 0), "inner");
  edit.remove(second(edit, 0), "never");
  EXPECT_EQ(edit.text(),
            "# of the machine\n[first]\na = 1   # one\n\n# about the second\n[[second]]\n"
            "name = \"Grüße\"\n[[second]]\nname = \"other\"");
}

TEST(TomlEdit, AppendsBehindTheTablesWithin) {
  TomlEdit edit = edit_of(kText);
  edit.append(second(edit, 0), "[second.new]\nx = 1\n");
  edit.append(second(edit, 1), "[second.new]\nx = 2\n");
  const std::string text = edit.text();
  EXPECT_NE(text.find("c = { d = 1 }\n[second.new]\nx = 1\n[[second]]\n"), std::string::npos)
      << text;
  EXPECT_TRUE(text.ends_with("name = \"other\"\n[second.new]\nx = 2\n")) << text;
}

TEST(TomlEdit, RefusesWhatIsNoToml) {
  const auto edit = TomlEdit::make("a = 1\nb = \n", "a.toml");
  ASSERT_FALSE(edit);
  EXPECT_TRUE(edit.error().message.starts_with("a.toml:2: ")) << edit.error().message;
}

}  // namespace
}  // namespace orbwatch::app
