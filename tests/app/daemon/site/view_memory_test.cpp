// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/site/view_memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/daemon/site/site_check.h"
#include "tests/app/daemon/demo_site.h"

namespace orbwatch::app::daemon {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t kGigabyte = 1'000'000'000;
constexpr int kLargest = 16384;

/// Site with twelve of the largest views that the files may state.
files::Resolved large_site() {
  files::Resolved site = demo();
  site.recipes.clear();
  const auto view = site.site.views.front();
  site.site.views.assign(12, view);
  for (pipeline::ViewSettings& each : site.site.views) each.width = each.height = kLargest;
  return site;
}

TEST(ViewMemory, IsThatOfAllDisplayViewsAndTheLargestRecipe) {
  files::Resolved site = large_site();
  EXPECT_EQ(view_memory(site), std::uint64_t{12} * 4 * kLargest * kLargest);
  pipeline::Recipe recipe = demo().recipes.front();
  recipe.views.resize(1);
  recipe.views.front().width = 100;
  recipe.views.front().height = 10;
  site.site.views.clear();
  site.recipes = {recipe, recipe};
  site.recipes.back().views.front().height = 20;
  EXPECT_EQ(view_memory(site), 6U * 100 * 20) << "one recipe is measured at a time";
}

TEST(ViewMemory, OfMoreThanTheComputerHasIsRefused) {
  const files::Resolved site = large_site();
  const auto checked = check_view_memory(site, 8 * kGigabyte);
  ASSERT_FALSE(checked);
  EXPECT_THAT(checked.error().message, HasSubstr("need 12.9 GB"));
  EXPECT_THAT(checked.error().message, HasSubstr("has 8.0 GB"));
  EXPECT_TRUE(check_view_memory(site, 16 * kGigabyte));
  EXPECT_TRUE(check_view_memory(site, 0)) << "unknown";
  EXPECT_TRUE(check_view_memory(demo(), kGigabyte));
}

TEST(ViewMemory, IsPartOfTheCheckOfASite) {
  ASSERT_GT(computer_memory(), 0U);
  files::Resolved site = large_site();
  const auto view = site.site.views.front();
  const std::uint64_t each = std::uint64_t{4} * kLargest * kLargest;
  site.site.views.assign(computer_memory() / each + 1, view);
  const auto checked = check_site(site, Dates::Ignored);
  ASSERT_FALSE(checked);
  EXPECT_THAT(checked.error().message, HasSubstr("this computer has"));
}

}  // namespace
}  // namespace orbwatch::app::daemon
