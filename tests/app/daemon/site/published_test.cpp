// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/site/published.h"

#include <gtest/gtest.h>

#include "tests/app/daemon/demo_site.h"

namespace orbwatch::app::daemon {
namespace {

/// The demonstration with one display view: pictures of the ball by the colour camera, then by the
/// thermal one.
files::Resolved with_ball_view() {
  files::Resolved site = demo();
  Located<pipeline::ViewSettings> view = site.site.views.front();
  view.kind = optics::ViewKind::Ball;
  view.h_fov.reset();
  view.v_fov.reset();
  view.sources.resize(1, view.sources.front());
  view.sources.push_back(view.sources.front());
  view.sources.front().camera = {"colour", 0};
  view.sources.back().camera = {"thermal", kThermalCamera};
  site.site.views = {view};
  site.recipes.clear();
  site.site.recipes.clear();
  const auto resolved = resolve_references(site, "site.toml");
  EXPECT_TRUE(resolved) << resolved.error().message;
  return site;
}

/// Where the pixel in the middle of the ball's picture looks.
optics::Vec3 middle_of_ball(const files::Resolved& site) {
  const auto plan = SitePlan::make(site, expected_formats(site));
  EXPECT_TRUE(plan) << plan.error().message;
  if (!plan) return {};
  const auto views = published_views(site, *plan);
  EXPECT_TRUE(views.front().ball);
  if (!views.front().ball) return {};
  const pipeline::ViewSettings& view = site.site.views.front();
  return views.front()
      .ball->direction(view.width / 2.0, view.height / 2.0)
      .value_or(optics::Vec3{});
}

TEST(Published, ABallsPictureIsThatOfTheFirstCameraThatIsShown) {
  files::Resolved both = with_ball_view();
  files::Resolved thermal = both;
  auto& sources = thermal.site.views.front().sources;
  sources.erase(sources.begin());
  const auto by_colour = middle_of_ball(both), by_thermal = middle_of_ball(thermal);
  EXPECT_LT(optics::dot(by_colour, by_thermal), 0.999) << "the cameras stand apart";
  both.rig.cameras[both.rig_cameras[0]].is_registered = false;
  const auto shown = middle_of_ball(both);
  EXPECT_GT(optics::dot(shown, by_thermal), 1 - 1e-9) << "the colour camera is left out";
}

TEST(Published, ACamerasWholePictureIsOfferedOnceItIsRegistered) {
  files::Resolved site = demo();
  const auto balls = camera_balls(site);
  ASSERT_EQ(balls.size(), 2U);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const optics::RigCamera& camera = site.rig_camera(i);
    ASSERT_TRUE(balls[i]);
    EXPECT_EQ(balls[i]->width(), camera.width);
    const optics::Vec2 middle{(camera.width - 1) / 2.0, (camera.height - 1) / 2.0};
    EXPECT_TRUE(balls[i]->direction(middle.u, middle.v)) << "the demo's cameras aim at the ball";
  }
  site.rig.cameras[site.rig_cameras[kThermalCamera]].is_registered = false;
  EXPECT_FALSE(camera_balls(site)[kThermalCamera]) << "it would show things in wrong places";
  EXPECT_TRUE(camera_balls(site)[0]);
}

TEST(Published, RecipesHaveTheOutlinesThatAreMeasured) {
  const files::Resolved site = demo();
  const auto plan = SitePlan::make(site, expected_formats(site));
  ASSERT_TRUE(plan) << plan.error().message;
  const auto recipes = measured_recipes(site, *plan);
  ASSERT_EQ(recipes.size(), plan->recipes.size());
  for (std::size_t i = 0; i < recipes.front().regions.size(); ++i) {
    const auto& outline = plan->recipes.front().regions[i].settings.outline;
    ASSERT_EQ(recipes.front().regions[i].outline.size(), outline.size());
    for (std::size_t k = 0; k < outline.size(); ++k) {
      EXPECT_EQ(recipes.front().regions[i].outline[k].x, outline[k].x);
    }
  }
  const auto views = published_views(site, *plan);
  EXPECT_FALSE(views.front().measured);
  EXPECT_TRUE(views[site.recipes.front().views.front().index].measured);
}

}  // namespace
}  // namespace orbwatch::app::daemon
