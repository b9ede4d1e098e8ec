#include "app/files/site_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace orbwatch::app {
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
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  tests::TemporaryFolder folder_;
  fs::path site_ = folder_ / "demo.toml";
  fs::path state_ = folder_ / "state";
};

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
}

}  // namespace
}  // namespace orbwatch::app
