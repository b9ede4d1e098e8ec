// SPDX-License-Identifier: Apache-2.0
#include "app/files/runtime/site_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace orbwatch::app::files {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(SiteFile, IsGivenOrNamedByTheEnvironmentOrTheInstalledOne) {
  ::setenv("ORBWATCH_CONFIG", "/etc/orbwatch/second/site.toml", 1);
  EXPECT_EQ(site_file("mine.toml"), "mine.toml");
  EXPECT_EQ(site_file({}), "/etc/orbwatch/second/site.toml");
  ::unsetenv("ORBWATCH_CONFIG");
  EXPECT_EQ(site_file({}), "/etc/orbwatch/site.toml");
}

class LastGood : public testing::Test {
 protected:
  LastGood() {
    for (const char* name : {"demo.toml", "demo-rig.toml", "demo-recipe.toml"}) {
      fs::copy_file(fs::path(ORBWATCH_SOURCE_DIR) / "platform/config" / name, folder_ / name);
    }
  }
  static std::string text_of(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  tests::TemporaryFolder folder_;
  fs::path site_ = folder_ / "demo.toml";
  fs::path state_ = folder_ / "state";
};

/// It repeats texts that may be confidential.
TEST_F(LastGood, IsForItsOwnerAlone) {
  ASSERT_TRUE(keep_last_good(state_, resolve(site_).value()));
  for (const char* name : {"last-good.json", "last-good-calibration.json"}) {
    EXPECT_EQ(fs::status(state_ / name).permissions(), fs::perms(0600)) << name;
  }
}

TEST_F(LastGood, RunsWhateverBecomesOfTheFiles) {
  const auto good = resolve(site_);
  ASSERT_TRUE(good) << good.error().message;
  ASSERT_TRUE(keep_last_good(state_, *good));
  write("demo.toml", "nonsense = ");
  write("demo-recipe.toml", "nonsense = ");
  fs::remove(folder_ / "demo-rig.toml");
  ASSERT_FALSE(resolve(site_));
  const auto kept = resolve_last_good(state_, site_);
  ASSERT_TRUE(kept) << kept.error().message;
  EXPECT_EQ(kept->checksum, good->checksum);
  EXPECT_EQ(kept->site.rig.path, good->site.rig.path)
      << "relative paths count from the same folder";
  EXPECT_EQ(kept->recipes.size(), good->recipes.size());
}

TEST_F(LastGood, SaysWhatIsMissing) {
  EXPECT_THAT(resolve_last_good(state_, site_).error().message, HasSubstr("no configuration ran"));
  const auto good = resolve(site_);
  ASSERT_TRUE(keep_last_good(state_, *good));
  EXPECT_THAT(resolve_last_good(state_, "other.toml").error().message, HasSubstr("was not other"));
  write("state/last-good.json", "{\"cut");
  EXPECT_THAT(resolve_last_good(state_, site_).error().message, HasSubstr("is damaged"));
  write("state/last-good.json", "{\"site\": 1}");
  EXPECT_THAT(resolve_last_good(state_, site_).error().message, HasSubstr("is damaged"));
  fs::remove(state_ / "last-good.json");
  ASSERT_EQ(::mkfifo((state_ / "last-good.json").c_str(), 0600), 0);
  EXPECT_THAT(resolve_last_good(state_, site_).error().message,
              HasSubstr("last-good.json: cannot be read: is a pipe"));
}

/// Accepted alignments are the present ones; if these are damaged, the kept ones.
TEST_F(LastGood, HasTheAlignmentsOfNowUnlessTheyAreDamaged) {
  write("demo.toml", "state_folder = \"state\"\n" + text_of(site_));
  const auto good = resolve(site_);
  ASSERT_TRUE(good) << good.error().message;
  CalibrationEntry entry;
  entry.rig = rig_checksum(folder_ / "demo-rig.toml").value();
  entry.alignment.cameras.push_back({.camera = good->site.cameras.front().name});
  fs::create_directories(state_);
  const auto kept = [&](const std::string& method) {
    entry.method = method;
    std::vector<CalibrationEntry> entries;
    accept(entries, entry);
    ASSERT_TRUE(save_calibrations(calibration_file(state_), entries));
  };
  const auto method_in_force = [&]() -> std::string {
    const auto last = resolve_last_good(state_, site_);
    if (!last) return last.error().message;
    return last->alignments.empty() ? "" : last->alignments.front().method;
  };
  kept("kept");
  ASSERT_TRUE(keep_last_good(state_, resolve(site_).value()));
  kept("accepted later");
  EXPECT_EQ(method_in_force(), "accepted later");
  write("state/calibration.toml", "nonsense = ");
  EXPECT_EQ(method_in_force(), "kept");
  fs::remove(state_ / "last-good-calibration.json");
  EXPECT_THAT(method_in_force(), HasSubstr("calibration.toml:1: "));
  EXPECT_THAT(method_in_force(), HasSubstr("no alignments were kept"));

  fs::remove(state_ / "calibration.toml");
  ASSERT_TRUE(keep_last_good(state_, resolve(site_).value()));
  write("state/calibration.toml", "nonsense = ");
  EXPECT_EQ(method_in_force(), "") << "none was accepted then";
}

/// Opening a pipe without a writer would block.
TEST_F(LastGood, NoFileOfAConfigurationIsAPipeAFolderOrTooLarge) {
  write("demo.toml", "state_folder = \"state\"\n" + text_of(site_));
  fs::create_directories(state_);
  write("state/calibration.toml", "");
  ASSERT_TRUE(resolve(site_)) << resolve(site_).error().message;
  for (const std::string name :
       {"demo.toml", "demo-rig.toml", "demo-recipe.toml", "state/calibration.toml"}) {
    const fs::path file = folder_ / name;
    const std::string text = text_of(file);
    const auto refusal = [&] {
      const auto resolved = resolve(site_);
      return resolved ? name + " was read" : resolved.error().message;
    };
    fs::remove(file);
    ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
    EXPECT_THAT(refusal(),
                HasSubstr(name + ": cannot be read: is a pipe or a device, not a regular "
                                 "file; it must be a TOML file"));
    fs::remove(file);
    fs::create_directory(file);
    EXPECT_THAT(refusal(), HasSubstr(name + ": cannot be read: Is a directory"));
    fs::remove(file);
    write(name, text + std::string((std::size_t{1} << 20) - text.size(), '\n'));
    EXPECT_TRUE(resolve(site_)) << name << " has 1 MiB";
    write(name, text + std::string((std::size_t{1} << 20) + 1 - text.size(), '\n'));
    EXPECT_THAT(refusal(), HasSubstr(name + ": cannot be read: is larger than 1024 KiB"));
    write(name, text);
  }
}

}  // namespace
}  // namespace orbwatch::app::files
