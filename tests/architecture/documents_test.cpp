#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

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
  const fs::path root = ORBWATCH_SOURCE_DIR;
  static const std::regex kLink(R"rx(\]\(([^)#:]+)\)|src="([^":]+)")rx");
  int links = 0;
  for (auto it = fs::recursive_directory_iterator(root); it != fs::recursive_directory_iterator();
       ++it) {
    const std::string name = it->path().filename().string();
    if (it->is_directory() && (name == "build" || name == "out" || name.starts_with("."))) {
      it.disable_recursion_pending();
      continue;
    }
    if (it->path().extension() != ".md") continue;
    const std::string text = read(it->path());
    for (std::sregex_iterator link(text.begin(), text.end(), kLink), end; link != end; ++link) {
      const std::string target = (*link)[1].matched ? (*link)[1] : (*link)[2];
      EXPECT_TRUE(fs::exists(it->path().parent_path() / target)) << it->path() << " -> " << target;
      ++links;
    }
  }
  EXPECT_GT(links, 10);
}

TEST(Documents, CommandsOfTheReadmeAreExecutable) {
  const fs::path root = ORBWATCH_SOURCE_DIR;
  const std::string readme = read(root / "README.md");
  for (const char* command : {"platform/demo", "tests/run"}) {
    EXPECT_NE(readme.find(std::string("./") + command), std::string::npos);
    EXPECT_NE(fs::status(root / command).permissions() & fs::perms::owner_exec, fs::perms::none);
  }
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
