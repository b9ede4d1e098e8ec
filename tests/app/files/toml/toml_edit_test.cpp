// SPDX-License-Identifier: Apache-2.0
#include "app/files/toml/toml_edit.h"

#include <gmock/gmock.h>

#include <functional>

namespace orbwatch::app::files {
namespace {

TomlEdit edit_of(const std::string& text) {
  auto edit = TomlEdit::make(text, "a.toml");
  EXPECT_TRUE(edit) << edit.error().message;
  return std::move(*edit);
}

std::string finished(const TomlEdit& edit) {
  const auto text = edit.finish();
  EXPECT_TRUE(text) << text.error().message;
  return text.value_or("");
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
  EXPECT_EQ(finished(edit_of(kText)), kText);
  EXPECT_EQ(finished(edit_of("")), "");
}

TEST(TomlEdit, SetsValuesAndKeepsTheirComments) {
  TomlEdit edit = edit_of(kText);
  const toml::table& first = *edit.root()["first"].as_table();
  edit.set(first, "b", "[3]");
  edit.set(first, "a", "-1.5");
  const std::string text = finished(edit);
  EXPECT_NE(text.find("a = -1.5   # one\nb = [3]  # two\n"), std::string::npos) << text;
}

TEST(TomlEdit, CountsColumnsInCharacters) {
  TomlEdit edit = edit_of("a = [\"Grüße\", 1] # ä\nb = { \"ü\" = 2, c = 3 }\n");
  const toml::table& inner = *edit.root()["b"].as_table();
  edit.set(inner, "c", "4");
  EXPECT_EQ(finished(edit), "a = [\"Grüße\", 1] # ä\nb = { \"ü\" = 2, c = 4 }\n");
}

TEST(TomlEdit, AddsAValueBehindTheTablesLastOne) {
  TomlEdit edit = edit_of(kText);
  edit.set(*edit.root()["first"].as_table(), "c", "3");
  const std::string text = finished(edit);
  EXPECT_NE(text.find("  2]  # two\nc = 3\n\n# about the second\n"), std::string::npos) << text;
}

TEST(TomlEdit, AddsLinesWithTheEndsThatTheTextHas) {
  TomlEdit edit = edit_of("[a]\r\nb = 1\r\n# end");
  edit.set(*edit.root()["a"].as_table(), "c", "2");
  EXPECT_EQ(finished(edit), "[a]\r\nb = 1\r\nc = 2\r\n# end");
}

TEST(TomlEdit, ReplacesAPartOfAList) {
  TomlEdit edit = edit_of("a = [[1, 2], # ä\n  [ 3,4 ]] # end\n");
  const toml::node& second = *edit.root()["a"].as_array()->get(1);
  EXPECT_EQ(edit.text_of(second), "[ 3,4 ]");
  edit.replace(second, "[5, 6]");
  EXPECT_EQ(finished(edit), "a = [[1, 2], # ä\n  [5, 6]] # end\n");
}

TEST(TomlEdit, RemovesValuesAndTables) {
  TomlEdit edit = edit_of(kText);
  edit.remove(*edit.root()["first"].as_table(), "b");
  edit.remove(second(edit, 0), "inner");
  edit.remove(second(edit, 0), "never");
  EXPECT_EQ(finished(edit),
            "# of the machine\n[first]\na = 1   # one\n\n# about the second\n[[second]]\n"
            "name = \"Grüße\"\n[[second]]\nname = \"other\"");
}

TEST(TomlEdit, AddsTablesAfterTheNestedOnes) {
  TomlEdit edit = edit_of(kText);
  edit.add_element(*edit.root()["second"].as_array(), "second", "name = \"third\"\n");
  edit.add_table(second(edit, 0), "second.new", "x = 1\n");
  edit.add_table(second(edit, 1), "second.new", "x = 2\n");
  edit.set(*second(edit, 0)["inner"].as_table(), "e", "3");
  const std::string text = finished(edit);
  EXPECT_NE(text.find("c = { d = 1 }\ne = 3\n\n[second.new]\nx = 1\n[[second]]\n"),
            std::string::npos)
      << text;
  EXPECT_TRUE(
      text.ends_with("name = \"other\"\n\n[second.new]\nx = 2\n\n[[second]]\nname = \"third\"\n"))
      << text;
}

TEST(TomlEdit, AddsAValueInFrontOfARemovedTable) {
  TomlEdit edit = edit_of("[a]\nb = 1\n[c]\nd = 2\n[e]\n");
  edit.remove(edit.root(), "c");
  edit.set(*edit.root()["a"].as_table(), "f", "3");
  EXPECT_EQ(finished(edit), "[a]\nb = 1\nf = 3\n[e]\n");
}

TEST(TomlEdit, WritesSeveralLinesWithTheEndsThatTheTextHas) {
  TomlEdit edit = edit_of("a = [1]\r\nb = 2\r\n");
  edit.set(edit.root(), "a", "[\n  3,\n]");
  EXPECT_EQ(finished(edit), "a = [\r\n  3,\r\n]\r\nb = 2\r\n");
}

TEST(TomlEdit, KeepsValuesThatEqualNothing) {
  TomlEdit edit = edit_of("[a]\nb = nan\nc = 1979-05-27T07:32:00Z\nd = 1\n");
  edit.set(*edit.root()["a"].as_table(), "d", "nan");
  EXPECT_EQ(finished(edit), "[a]\nb = nan\nc = 1979-05-27T07:32:00Z\nd = nan\n");
}

TEST(TomlEdit, RemovesTheLastElementOfAList) {
  TomlEdit edit = edit_of("[[a]]\nb = 1\n[c]\nd = 2\n");
  edit.remove(*edit.root()["a"].as_array()->get(0)->as_table());
  EXPECT_EQ(finished(edit), "[c]\nd = 2\n");
}

/// Change that the notation of the text does not permit: another key would be changed, or none.
struct Impossible {
  std::string name;
  std::string text;
  std::function<void(TomlEdit&)> change;
};

const toml::table& table_a(const TomlEdit& edit) { return *edit.root()["a"].as_table(); }
const toml::array& list_a(const TomlEdit& edit) { return *edit.root()["a"].as_array(); }

const std::vector<Impossible> kImpossible = {
    {"KeyOfAnInlineTable", "a = { b = 1 }\n",
     [](TomlEdit& edit) { edit.set(table_a(edit), "c", "2"); }},
    {"RemovedKeyOfAnInlineTable", "a = { b = 1, c = 2 }\n",
     [](TomlEdit& edit) { edit.remove(table_a(edit), "b"); }},
    {"KeyOfDottedKeys", "a.b = 1\nc = 2\n",
     [](TomlEdit& edit) { edit.set(table_a(edit), "d", "3"); }},
    {"RemovedDottedKeys", "a.b = 1\nc = 2\n[d]\n",
     [](TomlEdit& edit) { edit.remove(edit.root(), "a"); }},
    {"TableWithoutAHeader", "[a.b]\nc = 1\n",
     [](TomlEdit& edit) { edit.set(table_a(edit), "d", "2"); }},
    {"ScatteredTable", "[a]\n[b]\nc = 1\n[a.d]\n",
     [](TomlEdit& edit) { edit.remove(edit.root(), "a"); }},
    {"TextThatLooksLikeAComment", "[a]\nb = \"\"\"\nc\n# d\"\"\"\n",
     [](TomlEdit& edit) { edit.set(table_a(edit), "e", "1"); }},
    {"ListOfInlineTables", "a = [{ b = 1 }]\nc = 2\n",
     [](TomlEdit& edit) { edit.add_element(list_a(edit), "a", "b = 2\n"); }},
    {"OneOfAListOfInlineTables", "a = [{ b = 1 }, { b = 2 }]\nc = 2\n",
     [](TomlEdit& edit) { edit.remove(*list_a(edit).get(0)->as_table()); }},
    {"ValueThatIsMore", "[a]\nb = 1\n",
     [](TomlEdit& edit) { edit.set(table_a(edit), "b", "2\nc = 3"); }},
    {"ValueThatIsNone", "[a]\nb = 1\n", [](TomlEdit& edit) { edit.set(table_a(edit), "b", ""); }},
    {"TwoChangesOfAValue", "[a]\nb = 1\n",
     [](TomlEdit& edit) {
       edit.set(table_a(edit), "b", "2");
       edit.set(table_a(edit), "b", "3");
     }},
    {"ChangeWithinARemovedTable", "[a]\nb = 1\n[c]\n",
     [](TomlEdit& edit) {
       edit.remove(edit.root(), "a");
       edit.set(table_a(edit), "b", "2");
     }},
    {"NameThatIsNotUtf8", "[a]\nb = 1\n",
     [](TomlEdit& edit) { edit.set(table_a(edit), "b", "\"\xFF\""); }}};

class ImpossibleEdit : public testing::TestWithParam<Impossible> {};

TEST_P(ImpossibleEdit, IsRefusedInOneLine) {
  TomlEdit edit = edit_of(GetParam().text);
  GetParam().change(edit);
  const auto text = edit.finish();
  ASSERT_FALSE(text) << *text;
  EXPECT_THAT(text.error().message, testing::StartsWith("a.toml: "));
  EXPECT_THAT(text.error().message, testing::Not(testing::HasSubstr("\n")));
}

INSTANTIATE_TEST_SUITE_P(TomlEdit, ImpossibleEdit, testing::ValuesIn(kImpossible),
                         [](const auto& info) { return info.param.name; });

TEST(TomlEdit, NamesTheValueThatWouldBeWrong) {
  TomlEdit edit = edit_of("[[a]]\n[[a]]\nb = { c = 1 }\n");
  edit.set(*list_a(edit).get(1)->at_path("b").as_table(), "d", "2");
  EXPECT_EQ(edit.finish().error().message,
            "a.toml: the change would make a[1].b.d wrong; write each table that changes with a "
            "header of its own");
}

TEST(TomlEdit, RefusesWhatIsNoToml) {
  const auto edit = TomlEdit::make("a = 1\nb = \n", "a.toml");
  ASSERT_FALSE(edit);
  EXPECT_TRUE(edit.error().message.starts_with("a.toml:2: ")) << edit.error().message;
}

}  // namespace
}  // namespace orbwatch::app::files
