// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/files/runtime/calibration_file.h"
#include "proc/align/register/registration.h"
#include "tests/app/alignment/rig_with_pose.h"
#include "tests/support/temporary_folder.h"

/// A camera with a pose that a person turns or whose outline is found is kept by outline and
/// registration: the same place, also from the file of accepted alignments.
namespace orbwatch::app {
namespace {

/// The rig after its camera was stated as it stands, accepted, and read again.
optics::Rig registered(const optics::Rig& rig) {
  const orbwatch::tests::TemporaryFolder folder;
  const auto turnable = align::by_outline(rig, rig.cameras.front());
  EXPECT_TRUE(turnable) << turnable.error().message;
  std::vector<CalibrationEntry> entries;
  CalibrationEntry entry;
  entry.method = "turned by hand";
  entry.alignment.cameras.push_back({.camera = turnable->name,
                                     .outline = turnable->outline,
                                     .registration = turnable->registration});
  files::accept(entries, entry);
  EXPECT_TRUE(files::save_calibrations(folder / "calibration.toml", entries));
  files::TextFiles files;
  optics::Rig read = rig;
  const auto applied =
      apply(load_calibrations(folder / "calibration.toml", files)->front().alignment, read);
  EXPECT_TRUE(applied) << applied.error().message;
  EXPECT_FALSE(read.cameras.front().pose);
  return read;
}

/// The furthest that two rigs put a direction apart, px.
double furthest(const optics::Rig& one, const optics::Rig& other) {
  const auto a = optics::ball_projection(one, one.cameras.front());
  const auto b = optics::ball_projection(other, other.cameras.front());
  EXPECT_TRUE(a && b);
  double most = 0;
  for (double yaw = -180; yaw < 180; yaw += 15) {
    for (double pitch = -75; pitch <= 75; pitch += 15) {
      const optics::Vec3 direction = optics::rotation({yaw, pitch, 0}) * optics::Vec3{0, 1, 0};
      const auto of_a = a->pixel(direction), of_b = b->pixel(direction);
      EXPECT_EQ(of_a.has_value(), of_b.has_value()) << yaw << " " << pitch;
      if (of_a && of_b) most = std::max(most, std::hypot(of_a->u - of_b->u, of_a->v - of_b->v));
    }
  }
  EXPECT_NEAR(a->distance(), b->distance(), 1e-3);
  return most;
}

void expect_keeps_its_place(const optics::Rig& rig) {
  EXPECT_LT(furthest(rig, registered(rig)), 0.02);
  optics::Rig moved = rig;
  moved.cameras.front().pose->position.x += 1;
  EXPECT_GT(furthest(rig, moved), 0.1) << "the test would see 1 mm";
}

TEST(PoseAsOutline, KeepsThePlaceOfACameraBesideTheBall) {
  expect_keeps_its_place(tests::rig_with_pose({100, -540, 440}));
}

TEST(PoseAsOutline, KeepsThePlaceBehindADistortingLens) {
  optics::Rig rig = tests::rig_with_pose({100, -540, 440});
  rig.cameras.front().intrinsics->distortion = optics::Distortion::Pinhole;
  rig.cameras.front().intrinsics->coefficients = {-0.2, 0.1, 0.001, -0.001};
  expect_keeps_its_place(rig);
}

TEST(PoseAsOutline, KeepsThePlaceBehindAWindow) {
  optics::Rig rig = tests::rig_with_pose({100, -540, 440});
  rig.cameras.front().window = optics::Window{optics::normalized(optics::Vec3{0.2, 1, 0}), 6, 1.5};
  expect_keeps_its_place(rig);
}

TEST(PoseAsOutline, KeepsTheScene) {
  optics::Rig rig = tests::rig_with_pose({100, -540, 440});
  rig.scene.room = optics::Scene::Room::Box;
  rig.scene.walls = {{-600, -700, 0}, {600, 500, 800}};
  expect_keeps_its_place(rig);
}

}  // namespace
}  // namespace orbwatch::app
