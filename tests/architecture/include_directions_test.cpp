#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

/// Who may include whom: the folders of the architecture, read from the sources themselves.
namespace orbwatch::tests {
namespace {

namespace fs = std::filesystem;

struct Rule {
  std::string folder;                ///< files below it ...
  std::vector<std::string> allowed;  ///< ... include our headers in these folders or files only,
  std::vector<std::string> foreign;  ///< and libraries whose headers start like this
};

/// A port sees the model and its own folder, never another port.
std::vector<std::string> port(const std::string& folder) {
  return {"proc",         "hal",       "app/model",        "app/log.h", "app/recent_log.h",
          "app/pictures", "app/state", "app/certificates", folder};
}

// The most specific rule counts. The standard library and the C library are allowed everywhere.
const std::vector<Rule> kRules{
    {"proc/image", {"proc/image"}, {"tl/expected"}},
    {"proc/settings", {"proc/settings"}, {}},
    {"proc/optics", {"proc/image", "proc/settings", "proc/optics"}, {"tl/expected"}},
    {"proc/remap", {"proc/image", "proc/settings", "proc/optics", "proc/remap"}, {"tl/expected"}},
    {"proc/signals",
     {"proc/image", "proc/settings", "proc/optics", "proc/signals"},
     {"tl/expected", "opencv2/"}},
    {"proc/align",
     {"proc/image", "proc/settings", "proc/optics", "proc/align"},
     {"tl/expected", "opencv2/", "ceres/", "Eigen/"}},
    {"hal", {"proc/image", "proc/settings", "hal"}, {"tl/expected", "gpiod", "linux/"}},
    {"hal/genicam",
     {"proc/image", "proc/settings", "hal"},
     {"tl/expected", "arv.h", "arpa/", "netinet/"}},
    {"hal/jpeg", {"proc/image", "proc/settings", "hal"}, {"tl/expected", "jpeglib", "jerror"}},
    {"hal/libcamera",
     {"proc/image", "proc/settings", "hal"},
     {"tl/expected", "libcamera/", "linux/"}},
    {"hal/replay", {"proc/image", "proc/settings", "hal"}, {"tl/expected", "opencv2/"}},
    {"hal/mosaic", {"proc/image", "hal/mosaic"}, {"tl/expected", "opencv2/"}},
    {"app",
     {"proc", "hal", "app"},
     {"opencv2/", "toml++/", "yaml-cpp/", "dds/", "modbus/", "tl/expected"}},
    {"app/model", {"proc", "hal", "app/model"}, {"tl/expected", "nlohmann/"}},
    {"app/files", {"proc", "hal", "app"}, {"nlohmann/", "toml++/", "yaml-cpp/", "tl/expected"}},
    {"app/ports/console", port("app/ports/console"), {"tl/expected"}},
    {"app/ports/lines", port("app/ports/lines"), {"tl/expected"}},
    {"app/ports/snapshot", port("app/ports/snapshot"), {"tl/expected"}},
    {"app/cli", {"proc", "hal", "app"}, {"nlohmann/", "opencv2/", "dds/", "tl/expected"}},
    {"app/ports/dds", port("app/ports/dds"), {"dds/", "tl/expected"}},
    {"app/ports/dds/generated", {"app/ports/dds/generated", "dds"}, {}},
    {"app/ports/dds/security",
     {"proc/image", "hal", "app/certificates", "app/ports/dds"},
     {"dds/", "openssl/", "tl/expected"}},
    {"app/ports/web", port("app/ports/web"), {"nlohmann/", "tl/expected"}},
    {"app/ports/web/access", port("app/ports/web"), {"nlohmann/", "sodium.h", "tl/expected"}},
    {"app/ports/web/http",
     {"proc/image", "proc/settings", "hal", "app/ports/web/http", "app/ports/web/web_settings.h"},
     {"microhttpd.h", "nlohmann/", "tl/expected"}},
    {"app/ports/web/status", port("app/ports/web"), {"nlohmann/", "prometheus/", "tl/expected"}},
    {"app/certificates", {"proc/image", "hal", "app/certificates"}, {"openssl/", "tl/expected"}},
    {"app/pictures", {"proc", "hal", "app/pictures"}, {"opencv2/", "turbojpeg", "tl/expected"}},
    {"app/ports/modbus", port("app/ports/modbus"), {"modbus/", "tl/expected"}},
    {"app/ports/modbus/map",
     {"proc", "hal", "app/model", "app/ports/modbus/map", "app/ports/modbus/modbus_settings.h",
      "app/state"},
     {"tl/expected"}},
    {"app/ports/modbus/server",
     {"proc", "hal", "app/ports/modbus/map", "app/ports/modbus/server",
      "app/ports/modbus/modbus_settings.h"},
     {"modbus/", "tl/expected"}},
    {"app/pipeline",
     {"proc", "hal", "app/model", "app/pipeline", "app/pictures", "app/log.h"},
     {"tl/expected"}},
    {"app/simulation", {"proc", "hal", "app/simulation"}, {"tl/expected"}},
    {"app/service",
     {"proc", "hal", "app/model", "app/service", "app/log.h", "app/log_writer.h"},
     {"systemd/", "tl/expected"}},
    {"app/state", {"proc", "hal", "app/model", "app/log.h", "app/state"}, {"tl/expected"}},
    {"app/health", {"proc", "hal", "app/model", "app/health", "app/log.h"}, {"tl/expected"}},
};

bool is_below(const std::string& path, const std::string& folder) {
  return path.starts_with(folder + "/");
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
  static const std::vector<std::string> kLibraries{"gpiod.h", "jerror.h", "jpeglib.h",
                                                   "microhttpd.h", "turbojpeg.h"};
  return header.find('/') == std::string::npos &&
         std::ranges::find(kLibraries, header) == kLibraries.end();
}

TEST(IncludeDirections, FollowTheArchitecture) {
  const auto includes = all_includes();
  EXPECT_GT(includes.size(), 300U);
  for (const Include& include : includes) {
    const Rule* rule = rule_for(include.file);
    ASSERT_TRUE(rule) << include.file << " is in no folder of the architecture";
    const auto& allowed = include.quoted ? rule->allowed : rule->foreign;
    const bool good = std::any_of(allowed.begin(), allowed.end(), [&](const std::string& prefix) {
      return include.quoted ? include.header == prefix || is_below(include.header, prefix)
                            : include.header.starts_with(prefix);
    });
    // idlc writes headers without a folder.
    const bool generated =
        include.quoted && is_below(include.file, "app/ports/dds") && is_standard(include.header);
    const bool standard = !include.quoted && is_standard(include.header);
    EXPECT_TRUE(good || standard || generated) << include.file << " includes " << include.header;
  }
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
