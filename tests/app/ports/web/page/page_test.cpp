// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "app/ports/web/page/page_files.h"
#include "tests/app/ports/web/served.h"

namespace orbwatch::app::web::tests {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;

const fs::path kFolder = ORBWATCH_SOURCE_DIR "/app/ports/web/page/files";

/// Paths of files in attributes of HTML and in imports of scripts, resolved relative to `file`.
std::set<std::string> files_named_in(const fs::path& file, const std::string& text) {
  static const std::regex kName(R"rx((?:src|href|from)(?:=| )"([^"#]+)")rx");
  std::set<std::string> names;
  for (auto found = std::sregex_iterator(text.begin(), text.end(), kName);
       found != std::sregex_iterator(); ++found) {
    names.insert((file.parent_path() / (*found)[1].str()).lexically_normal());
  }
  return names;
}

TEST_F(Served, EveryFileOfThePageIsServedAsItWasWritten) {
  start();
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kFolder)) {
    const std::string name = entry.path().lexically_relative(kFolder);
    if (entry.is_directory() || name.ends_with("README.md")) continue;
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string content(std::istreambuf_iterator<char>(file), {});
    const Answer answer = get(port(), name == "index.html" ? "/" : "/" + name);
    EXPECT_EQ(answer.status, 200) << name;
    EXPECT_EQ(answer.body, content) << name;
    EXPECT_EQ(answer.headers.at("Content-Type"), page_type(name));
    EXPECT_FALSE(page_type(name).empty()) << name << " has an ending without a type";
    ++files;
  }
  EXPECT_EQ(files, kPageFiles.size());
}

/// All files that the page loads, directly or indirectly, exist and come from the appliance.
TEST_F(Served, ThePageLoadsOnlyItsOwnFiles) {
  start();
  std::set<std::string> seen, open{""};
  while (!open.empty()) {
    const std::string name = *open.begin();
    open.erase(open.begin());
    if (!seen.insert(name).second) continue;
    const Answer answer = get(port(), "/" + name);
    ASSERT_EQ(answer.status, 200) << name;
    open.merge(files_named_in(name, answer.body));
  }
  EXPECT_EQ(seen.size(), kPageFiles.size()) << "some file is loaded by none";
}

/// The policy sent with the page forbids both.
TEST(Page, HasNoScriptOrStyleWithinTheHtml) {
  for (const PageFile& file : kPageFiles) {
    if (!file.name.ends_with(".html")) continue;
    const std::string html(file.content);
    EXPECT_FALSE(
        std::regex_search(html, std::regex(R"(<script(?![^>]*\ssrc=)|<style|\sstyle=|\son\w+=)")))
        << file.name;
  }
}

TEST_F(Served, TheDescriptionHasWhatProgramsAskForOnly) {
  start();
  const auto all = nlohmann::json::parse(get(port(), "/api/v1/openapi.json").body);
  EXPECT_TRUE(all["paths"].contains("/api/v1/live"));
  EXPECT_FALSE(all["paths"].contains("/"));
  EXPECT_FALSE(all["paths"].contains("/main.js"));
  const auto& camera = all["components"]["schemas"]["Status"]["properties"]["cameras"]["items"];
  EXPECT_EQ(camera["properties"]["latency_p50_ms"]["x-unit"], "ms");
}

}  // namespace
}  // namespace orbwatch::app::web::tests
