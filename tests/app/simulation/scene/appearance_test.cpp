// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/scene/appearance.h"

#include <gtest/gtest.h>

#include <string>

#include "app/simulation/scene/lettering.h"
#include "tests/app/simulation/projection.h"

namespace orbwatch::app::simulation {
namespace {

TEST(Lettering, ReadsFromLeftToRightAndUpright) {
  std::string picture;
  for (int row = 0; row < 7; ++row) {
    for (int column = 0; column < 11; ++column) {
      picture += on_ink("LF", 7, column - 5.0, 3.0 - row) ? '#' : '.';
    }
    picture += '\n';
  }
  EXPECT_EQ(picture,
            "#.....#####\n"
            "#.....#....\n"
            "#.....#....\n"
            "#.....####.\n"
            "#.....#....\n"
            "#.....#....\n"
            "#####.#....\n");
  EXPECT_FALSE(on_ink("LF", 7, -5.6, 0));
  EXPECT_FALSE(on_ink("LF", 7, 5.6, 3));
  EXPECT_FALSE(on_ink("LF", 7, -5, 3.6));
}

/// Wall, and a point that faces it.
struct Face {
  Surface surface;
  const char* name;
  Vec3 wall;  // the wall's middle
};

const Vec3 kMiddle{0, 0, 400};
const std::vector<Face> kFaces{
    {Surface::Left, "LEFT", {-600, 0, 400}},
    {Surface::Right, "RIGHT", {600, 0, 400}},
    {Surface::Front, "FRONT", {0, -500, 400}},
    {Surface::Back, "BACK", {0, 500, 400}},
};

Appearance seen(const Pinhole& camera, double u, double v, Surface* surface = nullptr) {
  const Ray ray = camera.ray_through(u, v);
  const StaticHit hit = nearest_static(kMachine, ray);
  if (surface) *surface = hit.surface;
  return appearance_of(kMachine, ray, hit);
}

TEST(Appearance, WallsBearTheirNamesUnmirroredForThoseWhoFaceThem) {
  for (const Face& face : kFaces) {
    const Pinhole camera = look_at(kMiddle, face.wall, 90, 1001, 1001);
    const double distance = norm(face.wall - kMiddle);
    int ink = 0;
    for (double right = -280.3; right <= 280; right += 4) {
      for (double up = 235.3; up <= 340; up += 4) {
        Surface surface = Surface::Outside;
        const Appearance look = seen(camera, camera.cx() + camera.focal_length * right / distance,
                                     camera.cy() - camera.focal_length * up / distance, &surface);
        ASSERT_EQ(surface, face.surface);
        // Expected colours: names are white, plates coloured, joints dark.
        const Light& light = look.light;
        const double least = std::min({light.x, light.y, light.z});
        const double most = std::max({light.x, light.y, light.z});
        const bool white = least > 0.97 * most && most > 0.2;
        // Names are centred at 0.36 of the height of 800 mm above the middle.
        ASSERT_EQ(white, on_ink(face.name, 90, right, up - 288)) << face.name;
        ink += white ? 1 : 0;
      }
    }
    EXPECT_GT(ink, 200) << face.name;
  }
}

TEST(Appearance, JointsAreStraightDarkCoolLines) {
  const Pinhole camera = look_at(kMiddle, {0, 500, 400}, 90, 1001, 1001);
  for (double along = -350; along <= 200; along += 7) {
    const double at = camera.focal_length / 500;
    const Appearance level = seen(camera, camera.cx() + along * at, camera.cy() - 100 * at);
    const Appearance upright = seen(camera, camera.cx() - 200 * at, camera.cy() - along * at);
    EXPECT_LT(norm(level.light), 0.1);
    EXPECT_LT(norm(upright.light), 0.1);
    EXPECT_EQ(level.temperature, 25);
  }
}

TEST(Appearance, EveryWallHasItsOwnColourAndTemperature) {
  std::vector<Appearance> looks;
  for (const Vec3& wall : {Vec3{-600, 30, 430}, Vec3{600, 30, 430}, Vec3{30, -500, 430},
                           Vec3{30, 500, 430}, Vec3{330, -330, 0}, Vec3{330, -330, 800}}) {
    const Ray ray{kMiddle, normalized(wall - kMiddle)};
    looks.push_back(appearance_of(kMachine, ray, nearest_static(kMachine, ray)));
  }
  for (std::size_t i = 0; i < looks.size(); ++i) {
    EXPECT_GT(looks[i].temperature, 18);
    EXPECT_LT(looks[i].temperature, 35);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT(norm(optics::normalized(looks[i].light) - optics::normalized(looks[j].light)) +
                    std::abs(looks[i].temperature - looks[j].temperature) / 10,
                0.1)
          << i << " and " << j;
    }
  }
}

TEST(Appearance, TheWorkpieceIsAsWarmAsItsSettingsSay) {
  const Ray down{{-110, -50, 700}, {0, 0, -1}};
  EXPECT_EQ(appearance_of(kMachine, down, nearest_static(kMachine, down)).temperature, 90);
}

}  // namespace
}  // namespace orbwatch::app::simulation
