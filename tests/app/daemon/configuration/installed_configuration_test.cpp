// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/configuration/installed_configuration.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/app/daemon/daemon_program.h"

/// Changes of a configuration's files by a page, concurrent with those of a user on the board.
namespace orbwatch::tests {
namespace {

using testing::HasSubstr;

class Installed : public Daemon {
 protected:
  Installed() {
    setenv("STATE_DIRECTORY", folder.path().c_str(), 1);
    file = write_config(small_machine(), kSmallRig, recipe);
  }
  ~Installed() override { unsetenv("STATE_DIRECTORY"); }

  app::RecipeChange limit_of(double value) const {
    return {{{1, "pool", "hot_spot_pixels", "high_alarm", value}}, {}};
  }

  const std::string recipe =
      kSmallRecipe + "[[region.alarm]]\nsignal = \"hot_spot_pixels\"\nhigh_alarm = 400\n";
  std::filesystem::path file;
};

TEST_F(Installed, KeepsNoTrialThatWouldRemoveAChangeMadeSinceItsTextWasRead) {
  app::daemon::InstalledConfiguration installed(file, {app::files::resolve(file).value(), "", {}});
  const auto edit = installed.with_changed_recipe(1, limit_of(450));
  ASSERT_TRUE(edit) << edit.error().message;
  std::ofstream(folder / "recipe.toml") << recipe << "# by hand\n";
  const auto change = installed.try_out(*edit, 60);
  ASSERT_TRUE(change) << change.error().message;
  ASSERT_TRUE(app::files::take_trial(folder.path()).value());
  const auto kept = installed.confirm();
  ASSERT_FALSE(kept);
  EXPECT_THAT(kept.error().message, HasSubstr("recipe.toml was changed by "));
  EXPECT_THAT(contents(folder / "recipe.toml"), HasSubstr("# by hand"));
}

TEST_F(Installed, KeepsATrialOfTheFileThatWasRead) {
  app::daemon::InstalledConfiguration installed(file, {app::files::resolve(file).value(), "", {}});
  const auto edit = installed.with_changed_recipe(1, limit_of(450));
  ASSERT_TRUE(edit) << edit.error().message;
  ASSERT_TRUE(installed.try_out(*edit, 60));
  ASSERT_TRUE(app::files::take_trial(folder.path()).value());
  const auto kept = installed.confirm();
  ASSERT_TRUE(kept) << kept.error().message;
  EXPECT_THAT(*kept, testing::ElementsAre("recipe.toml"));
  EXPECT_THAT(contents(folder / "recipe.toml"), HasSubstr("high_alarm = 450"));
}

TEST_F(Installed, RefusesAChecksumThatIsNone) {
  app::daemon::InstalledConfiguration installed(file, {app::files::resolve(file).value(), "", {}});
  auto edit = installed.with_changed_recipe(1, limit_of(450));
  ASSERT_TRUE(edit) << edit.error().message;
  for (const char* wrong : {"", "zz", "0a1b2c3d4e", "-1", "0x1"}) {
    edit->based_on["recipe.toml"] = wrong;
    const auto change = installed.try_out(*edit, 60);
    ASSERT_FALSE(change) << wrong;
    EXPECT_THAT(change.error().message, HasSubstr("hexadecimal")) << wrong;
  }
}

}  // namespace
}  // namespace orbwatch::tests
