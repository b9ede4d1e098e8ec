// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/architecture/markdown_files.h"

/// What the documents say about the tree must be there.
namespace orbwatch::tests {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(Documents, LinksLeadToFiles) {
  static const std::regex kLink(R"rx(\]\(([^)#:]+)\)|src="([^":]+)")rx");
  int links = 0;
  for (const fs::path& document : markdown_files()) {
    const std::string text = read(document);
    for (std::sregex_iterator link(text.begin(), text.end(), kLink), end; link != end; ++link) {
      const std::string target = (*link)[1].matched ? (*link)[1] : (*link)[2];
      EXPECT_TRUE(fs::exists(document.parent_path() / target)) << document << " -> " << target;
      ++links;
    }
  }
  EXPECT_GT(links, 10);
}

/// Anchor that forges make of a heading: "1. The page" -> "1-the-page".
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const unsigned char c : heading) {
    if (c >= 0x80 || std::isalnum(c) || c == '-' || c == '_') {
      anchor += static_cast<char>(c < 0x80 ? std::tolower(c) : c);
    } else if (c == ' ') {
      anchor += '-';
    }
  }
  return anchor;
}

std::vector<std::string> anchors_of(const std::string& text) {
  std::vector<std::string> anchors;
  std::istringstream in(text);
  bool is_code = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) is_code = !is_code;
    if (!is_code && line.starts_with('#')) {
      anchors.push_back(anchor_of(line.substr(line.find(' ') + 1)));
    }
  }
  return anchors;
}

TEST(Documents, LinksLeadToHeadings) {
  static const std::regex kLink(R"rx(\]\(([^)#: ]*)#([^)]+)\))rx");
  int links = 0;
  for (const fs::path& document : markdown_files()) {
    const std::string text = read(document);
    for (std::sregex_iterator link(text.begin(), text.end(), kLink), end; link != end; ++link) {
      const std::string target = (*link)[1];
      const auto anchors =
          anchors_of(target.empty() ? text : read(document.parent_path() / target));
      EXPECT_GT(std::ranges::count(anchors, (*link)[2].str()), 0)
          << document << " -> " << target << "#" << (*link)[2];
      ++links;
    }
  }
  EXPECT_GT(links, 10);
}

/// Links, and `folder/file` in backticks: from the root of the project or from the page's own
/// folder.
TEST(Documents, HowToAddNamesFilesThatExist) {
  const fs::path root = ORBWATCH_SOURCE_DIR;
  static const std::regex kFile(R"rx(\]\(([^)#:]+)\)|`([a-z0-9_/]+/[a-z0-9_]+\.[a-z]+)`)rx");
  for (const char* folder : {"app", "proc"}) {
    const std::string page = read(root / folder / "README.md");
    const std::size_t begin = page.find("## How to add");
    ASSERT_NE(begin, std::string::npos) << folder;
    const std::string section = page.substr(begin);
    int files = 0;
    for (std::sregex_iterator it(section.begin(), section.end(), kFile), end; it != end; ++it) {
      const std::string file = (*it)[1].matched ? (*it)[1] : (*it)[2];
      EXPECT_TRUE(fs::exists(root / file) || fs::exists(root / folder / file))
          << folder << "/README.md names " << file;
      ++files;
    }
    EXPECT_GT(files, 10) << folder;
  }
}

TEST(Documents, CommandsOfTheReadmeAreExecutable) {
  const fs::path root = ORBWATCH_SOURCE_DIR;
  const std::string readme = read(root / "README.md");
  for (const char* command : {"platform/demo", "tests/run"}) {
    EXPECT_NE(readme.find(std::string("./") + command), std::string::npos);
    EXPECT_NE(fs::status(root / command).permissions() & fs::perms::owner_exec, fs::perms::none);
  }
}

/// A licence within the first lines, by which tools find it (SPDX).
TEST(Documents, SourcesStateTheirLicence) {
  const fs::path root = ORBWATCH_SOURCE_DIR;
  const std::vector<std::string> kinds{".c", ".cmake", ".cpp", ".css", ".h", ".js", ".py"};
  int sources = 0;
  for (const char* top : {"app", "hal", "platform", "proc", "tests", "toolchains"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string file = entry.path().string();
      const bool is_source = std::ranges::count(kinds, entry.path().extension().string()) > 0 ||
                             entry.path().filename() == "CMakeLists.txt";
      // idlc writes what is generated.
      if (!is_source || file.find("/dds/generated/") != std::string::npos) continue;
      EXPECT_NE(read(entry.path()).substr(0, 100).find("SPDX-License-Identifier: Apache-2.0"),
                std::string::npos)
          << file;
      ++sources;
    }
  }
  EXPECT_GT(sources, 1000);
}

TEST(Documents, FullFoldersSayWhatLivesThere) {
  const fs::path root = ORBWATCH_SOURCE_DIR;
  constexpr int kHandful = 8;
  for (const char* top : {"app", "hal", "proc"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (!entry.is_directory()) continue;
      const auto files = std::count_if(fs::directory_iterator(entry), fs::directory_iterator(),
                                       [](const auto& e) { return e.is_regular_file(); });
      EXPECT_TRUE(files <= kHandful || fs::exists(entry.path() / "README.md")) << entry.path();
    }
  }
}

}  // namespace
}  // namespace orbwatch::tests
