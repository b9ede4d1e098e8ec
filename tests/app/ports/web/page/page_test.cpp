// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "app/ports/web/page/page_files.h"
#include "tests/app/ports/web/gunzip.h"
#include "tests/app/ports/web/served.h"

namespace orbwatch::app::web::tests {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;

const fs::path kFolder = ORBWATCH_SOURCE_DIR "/app/ports/web/page/files";

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

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

std::string path_of(const PageFile& file) {
  return file.name == "index.html" ? "/" : "/" + std::string(file.name);
}

TEST_F(Served, FilesOfThePageAreSentPackedToClientsThatAcceptIt) {
  start();
  for (const PageFile& file : kPageFiles) {
    const Answer plain = get(port(), path_of(file));
    const Answer packed = get(port(), path_of(file), "Accept-Encoding: br, gzip\r\n");
    EXPECT_EQ(plain.status, 200) << file.name;
    EXPECT_EQ(plain.body, file.content);
    EXPECT_FALSE(plain.headers.contains("Content-Encoding"));
    EXPECT_EQ(packed.status, 200) << file.name;
    EXPECT_EQ(packed.headers.at("Content-Encoding"), "gzip");
    EXPECT_LT(packed.body.size(), plain.body.size());
    EXPECT_EQ(gunzip(packed.body), plain.body) << file.name;
    for (const Answer* answer : {&plain, &packed}) {
      EXPECT_EQ(answer->headers.at("Vary"), "Accept-Encoding");
      EXPECT_EQ(answer->headers.at("Cache-Control"), "no-cache");
      EXPECT_EQ(answer->headers.at("Content-Type"), page_type(file.name));
      EXPECT_THAT(answer->headers.at("Content-Security-Policy"), HasSubstr("script-src 'self'"));
    }
    EXPECT_FALSE(page_type(file.name).empty()) << file.name << " has an ending without a type";
  }
}

TEST_F(Served, FilesOfThePageAreSentAgainOnlyWhenTheyHaveChanged) {
  start();
  std::set<std::string> tags;
  for (const PageFile& file : kPageFiles) {
    const std::string tag = get(port(), path_of(file)).headers.at("ETag");
    EXPECT_TRUE(tags.insert(tag).second) << file.name << " has the tag of another file";
    for (const char* accepts : {"", "Accept-Encoding: gzip\r\n"}) {
      const Answer same = get(port(), path_of(file), "If-None-Match: " + tag + "\r\n" + accepts);
      EXPECT_EQ(same.status, 304) << file.name;
      EXPECT_TRUE(same.body.empty());
      EXPECT_EQ(same.headers.at("ETag"), tag);
      EXPECT_EQ(same.headers.at("Vary"), "Accept-Encoding");
      EXPECT_EQ(same.headers.at("Cache-Control"), "no-cache");
      EXPECT_FALSE(same.headers.contains("Content-Encoding"));
      const Answer other =
          get(port(), path_of(file), std::string("If-None-Match: \"x\"\r\n") + accepts);
      EXPECT_EQ(other.status, 200) << file.name;
      EXPECT_EQ(other.headers.at("ETag"), tag);
    }
  }
}

/// Files that are not bundled are the sources themselves.
TEST_F(Served, HtmlAndIconAreServedAsTheyWereWritten) {
  start();
  EXPECT_EQ(get(port(), "/").body, read(kFolder / "index.html"));
  EXPECT_EQ(get(port(), "/operator").body, read(kFolder / "index.html"));
  EXPECT_EQ(get(port(), "/icon.svg").body, read(kFolder / "icon.svg"));
}

TEST_F(Served, ThePageLoadsOnlyItsOwnFiles) {
  start();
  std::set<std::string> served;
  for (const PageFile& file : kPageFiles) served.insert(std::string(file.name));
  std::set<std::string> loaded = files_named_in("", get(port(), "/").body);
  loaded.insert("index.html");
  const std::string script = get(port(), "/main.js").body;
  // Texts of another language, which the script names.
  for (const std::string& name : served) {
    if (script.find("\"./" + name + '"') != std::string::npos) loaded.insert(name);
  }
  EXPECT_EQ(loaded, served);
  EXPECT_FALSE(std::regex_search(script, std::regex(R"(\bimport\s*["'{*]|\bimport\(["'`])")));
  EXPECT_EQ(script.find("sourceMappingURL"), std::string::npos);
}

/// The bundle holds what the page loads, directly or indirectly.
TEST(Page, HasNoFileThatNoneLoads) {
  std::set<std::string> loaded, open{"index.html", "texts/de.js", "texts/ja.js"}, files;
  while (!open.empty()) {
    const std::string name = *open.begin();
    open.erase(open.begin());
    if (loaded.insert(name).second) open.merge(files_named_in(name, read(kFolder / name)));
  }
  for (const auto& entry : fs::recursive_directory_iterator(kFolder)) {
    const std::string name = entry.path().lexically_relative(kFolder);
    if (entry.is_regular_file() && !name.ends_with("README.md")) files.insert(name);
  }
  EXPECT_EQ(loaded, files);
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
