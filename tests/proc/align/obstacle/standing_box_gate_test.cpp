// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <optional>
#include <random>

#include "proc/align/obstacle/standing_box.h"
#include "proc/align/register/gradients/gradient_registration.h"
#include "proc/align/register/spiral.h"
#include "proc/align/rotation_fit.h"
#include "tests/proc/align/register/camera_pair.h"
#include "tests/support/share.h"

/// An unstated box is found in simulated rooms, and none in rooms without one.
namespace orbwatch::tests {
namespace {

using optics::Vec3;

/// Angles in degrees between the directions that a camera's projection assigns to its pixels and
/// the true ones: sum of squares and number, over even directions.
struct ViewError {
  double squares = 0;
  int count = 0;

  void add(const optics::BallProjection& ball, const MirrorRoomPicture& seen) {
    constexpr int kDirections = 4000;
    for (int n = 0; n < kDirections; ++n) {
      const Vec3 direction = align::spiral(n, kDirections);
      if (dot(direction, ball.facing()) < std::cos(optics::radians(150))) continue;
      const auto pixel = ball.pixel(direction);
      const auto point = pixel ? seen.mirrored(*pixel) : std::nullopt;
      if (!point) continue;
      squares += std::pow(optics::degrees(norm(direction - optics::normalized(*point))), 2);
      ++count;
    }
  }
  double rms() const { return std::sqrt(squares / count); }
};

/// Result for one room.
struct Outcome {
  bool found = false;
  double before = 0;  ///< degrees rms of both cameras' views
  double after = 0;
};

/// Error of both cameras' views with the room stated by `rig`.
double view_error(const CameraPair& pair, const optics::Rig& rig, const optics::RigCamera& second) {
  ViewError error;
  error.add(optics::ball_projection(rig, pair.known).value(), pair.room.first);
  error.add(optics::ball_projection(rig, second).value(), pair.room.second);
  return error.rms();
}

/// nullopt when the cameras are not registered.
std::optional<Outcome> run(std::uint64_t seed, bool table, bool boxes_stated) {
  CameraPair pair = camera_pair(seed, true, table);
  if (pair.room.table) pair.rig.scene.obstacles.pop_back();
  if (!boxes_stated) pair.rig.scene.obstacles.clear();
  std::mt19937_64 random(seed);
  std::normal_distribution<double> any;
  const Vec3 axis = optics::normalized({any(random), any(random), any(random)});
  align::SoughtCamera sought = pair.unknown();
  sought.camera.registration = align::rotation_about(axis * optics::radians(4)) * pair.truth;
  sought.keeps_outline = true;
  const auto registered = align::register_by_gradients(pair.reference(), sought);
  if (!registered) return std::nullopt;
  sought.camera.registration = registered->rotation;

  Outcome outcome;
  outcome.before = outcome.after = view_error(pair, pair.rig, sought.camera);
  const align::ReferenceCamera second{sought.picture,
                                      optics::ball_projection(pair.rig, sought.camera).value()};
  const auto box = align::find_standing_box(pair.reference(), second, pair.rig.scene);
  if (!box) return outcome;
  outcome.found = true;
  optics::Rig rig = pair.rig;
  rig.scene.obstacles.push_back(box->box);
  outcome.after = view_error(pair, rig, sought.camera);
  std::printf("seed %llu: significance %.2f, views off by %.2f deg rms, with the box by %.2f\n",
              static_cast<unsigned long long>(seed), box->significance, outcome.before,
              outcome.after);
  return outcome;
}

/// Runs `count` rooms of seeds from `first` on; none of them is made worse. Most boxes are not
/// proven.
void rooms(int count, std::uint64_t first, bool table, bool boxes_stated) {
  int found = 0, registered = 0;
  for (int n = 0; n < count; ++n) {
    const auto outcome = run(first + static_cast<std::uint64_t>(n), table, boxes_stated);
    if (!outcome) continue;
    ++registered;
    found += outcome->found ? 1 : 0;
    EXPECT_LE(outcome->after, outcome->before) << "seed " << first + static_cast<std::uint64_t>(n);
  }
  std::printf("%d boxes found in %d rooms\n", found, registered);
  testing::Test::RecordProperty("boxes found", found);
  testing::Test::RecordProperty("rooms", registered);
}

TEST(StandingBoxGate, ATableThatIsNotStated) { rooms(share_of(40), 170'000, true, true); }

TEST(StandingBoxGate, NoTable) { rooms(share_of(40), 171'000, false, true); }

TEST(StandingBoxGate, NoBoxStatedAtAll) {
  const int cases = share_of(40);
  rooms(cases, 172'000, false, false);
  rooms(cases, 173'000, true, false);
}

}  // namespace
}  // namespace orbwatch::tests
