// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/architecture/include_rules.h"

/// Who may include whom, read from the sources themselves.
namespace orbwatch::tests {
namespace {

namespace fs = std::filesystem;

bool is_below(const std::string& path, const std::string& folder) {
  return path.starts_with(folder + "/");
}

/// A rule's `allowed` names the header, its folder, or both ends of its path around a `*`.
bool permits(const std::string& allowed, const std::string& header) {
  const std::size_t star = allowed.find('*');
  if (star == std::string::npos) return header == allowed || is_below(header, allowed);
  return header.starts_with(allowed.substr(0, star)) && header.ends_with(allowed.substr(star + 1));
}

const Rule* rule_for(const std::string& file) {
  const Rule* best = nullptr;
  for (const Rule& rule : kRules) {
    if (is_below(file, rule.folder) && (!best || rule.folder.size() > best->folder.size())) {
      best = &rule;
    }
  }
  return best;
}

struct Include {
  std::string file;    ///< from the project's root
  std::string header;  ///< as written
  bool quoted = false;
};

std::vector<Include> includes_of(const fs::path& root, const fs::path& file) {
  static const std::regex kPattern(R"rx(^\s*#\s*include\s*(["<])([^">]+)[">])rx");
  std::vector<Include> found;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (std::regex_search(line, match, kPattern)) {
      found.push_back({fs::relative(file, root).string(), match[2], match[1] == "\""});
    }
  }
  return found;
}

std::vector<Include> all_includes() {
  const fs::path root = ORBWATCH_SOURCE_DIR;
  std::vector<Include> all;
  for (const char* top : {"proc", "hal", "app"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const auto extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp" && extension != ".idl") continue;
      const auto found = includes_of(root, entry.path());
      all.insert(all.end(), found.begin(), found.end());
    }
  }
  return all;
}

/// Headers without a folder or with one of the system's are the C and C++ libraries'.
bool is_standard(const std::string& header) {
  static const std::vector<std::string> kSystem{"sys/", "net/", "netinet/", "arpa/"};
  if (std::any_of(kSystem.begin(), kSystem.end(),
                  [&](const auto& s) { return header.starts_with(s); })) {
    return true;
  }
  static const std::vector<std::string> kLibraries{
      "gpiod.h", "jerror.h", "jpeglib.h", "microhttpd.h", "png.h", "turbojpeg.h", "zstd.h"};
  return header.find('/') == std::string::npos &&
         std::ranges::find(kLibraries, header) == kLibraries.end();
}

TEST(IncludeDirections, ArePermittedByHeaderFolderOrPattern) {
  EXPECT_TRUE(permits("app/log.h", "app/log.h"));
  EXPECT_TRUE(permits("app/ports", "app/ports/web/web_sink.h"));
  EXPECT_FALSE(permits("app/ports", "app/ports_of_call.h"));
  EXPECT_TRUE(permits("app/ports/*_settings.h", "app/ports/web/web_settings.h"));
  EXPECT_FALSE(permits("app/ports/*_settings.h", "app/ports/web/web_sink.h"));
  EXPECT_FALSE(permits("app/ports/*_settings.h", "app/pipeline/pipeline_settings.h"));
}

TEST(IncludeDirections, FollowTheArchitecture) {
  const auto includes = all_includes();
  EXPECT_GT(includes.size(), 300U);
  for (const Include& include : includes) {
    const Rule* rule = rule_for(include.file);
    ASSERT_TRUE(rule) << include.file << " is in no folder of the architecture";
    const auto& allowed = include.quoted ? rule->allowed : rule->foreign;
    const bool good = std::any_of(allowed.begin(), allowed.end(), [&](const std::string& prefix) {
      return include.quoted ? permits(prefix, include.header) : include.header.starts_with(prefix);
    });
    // idlc writes headers without a folder.
    const bool generated =
        include.quoted && is_below(include.file, "app/ports/dds") && is_standard(include.header);
    const bool standard = !include.quoted && is_standard(include.header);
    EXPECT_TRUE(good || standard || generated) << include.file << " includes " << include.header;
  }
}

/// Folders below app: its rooms, and each port.
std::set<std::string> rooms() {
  std::set<std::string> found;
  for (const std::string top : {"app", "app/ports"}) {
    for (const auto& entry : fs::directory_iterator(fs::path(ORBWATCH_SOURCE_DIR) / top)) {
      if (entry.is_directory()) found.insert(top + "/" + entry.path().filename().string());
    }
  }
  found.erase("app/ports");
  return found;
}

TEST(IncludeDirections, KnowEveryRoom) {
  EXPECT_GT(rooms().size(), 15U);
  for (const std::string& room : rooms()) {
    EXPECT_TRUE(std::ranges::any_of(kRules, [&](const Rule& rule) { return rule.folder == room; }))
        << room << " has no rule of its own in include_rules.h";
  }
  for (const Rule& rule : kRules) {
    EXPECT_TRUE(fs::is_directory(fs::path(ORBWATCH_SOURCE_DIR) / rule.folder)) << rule.folder;
  }
}

/// The other rooms of app that a rule allows, as app/README.md lists them: "model, log, ports
/// settings".
std::string may_use(const Rule& rule) {
  std::string text;
  std::set<std::string> listed;
  for (const std::string& allowed : rule.allowed) {
    if (allowed == "app") return "everything";
    if (!is_below(allowed, "app") || allowed == rule.folder) continue;
    std::string name = allowed.substr(4);
    if (name.ends_with(".h")) name.resize(name.size() - 2);
    if (const auto star = name.find("/*_"); star != std::string::npos) name.replace(star, 3, " ");
    if (name == "log_writer" || name == "recent_log") name = "log";
    if (!listed.insert(name).second) continue;
    text += (text.empty() ? "" : ", ") + name;
  }
  return text.empty() ? "itself" : text;
}

/// The last column of the table of rooms in app/README.md, by folder.
std::map<std::string, std::string> documented_uses() {
  static const std::regex kRow(R"rx(^\| `([a-z]+)/` \| .* \| ([^|]+) \|$)rx");
  std::map<std::string, std::string> uses;
  std::ifstream in(fs::path(ORBWATCH_SOURCE_DIR) / "app/README.md");
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (std::regex_match(line, match, kRow)) uses["app/" + match[1].str()] = match[2];
  }
  return uses;
}

TEST(IncludeDirections, AreThoseOfTheReadme) {
  std::map<std::string, std::string> expected{
      {"app/ports", may_use({"app/ports", port("app/ports"), {}})}};
  for (const Rule& rule : kRules) {
    if (fs::path(rule.folder).parent_path() == "app") expected[rule.folder] = may_use(rule);
  }
  EXPECT_EQ(documented_uses(), expected) << "the last column of app/README.md is stale";
}

TEST(IncludeDirections, TheSimulationSeesNoBallModel) {
  // Its truth must stay independent of what it is the truth for.
  for (const Include& include : all_includes()) {
    if (is_below(include.file, "app/simulation") && is_below(include.header, "proc/optics")) {
      EXPECT_EQ(include.header, "proc/optics/vec.h") << include.file;
    }
  }
}

TEST(IncludeDirections, RemapHasOnePublicHeader) {
  for (const Include& include : all_includes()) {
    if (is_below(include.file, "proc/remap") || !is_below(include.header, "proc/remap")) continue;
    EXPECT_EQ(include.header, "proc/remap/remap.h") << include.file;
  }
}

TEST(Folders, AreThoseOfTheArchitecture) {
  std::vector<std::string> unexpected;
  const std::vector<std::string> known{"app",      "build", "hal",   "out",
                                       "platform", "proc",  "tests", "toolchains"};
  for (const auto& entry : fs::directory_iterator(ORBWATCH_SOURCE_DIR)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && !name.starts_with(".") &&
        std::find(known.begin(), known.end(), name) == known.end()) {
      unexpected.push_back(name);
    }
  }
  EXPECT_TRUE(unexpected.empty()) << unexpected.front();
}

}  // namespace
}  // namespace orbwatch::tests
