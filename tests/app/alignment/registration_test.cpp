// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/registration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "proc/align/rotation_fit.h"
#include "proc/optics/rotation.h"
#include "tests/app/alignment/rig_with_pose.h"
#include "tests/proc/align/register/camera_pair.h"

namespace orbwatch::app {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kWindow{10};

/// Pictures that tell their time by their width.
std::vector<RecordedPicture> taken_at(const std::vector<int>& times) {
  std::vector<RecordedPicture> pictures;
  for (const int time : times) {
    RecordedPicture& picture = pictures.emplace_back();
    picture.picture.width = time;
    picture.time = milliseconds(time);
  }
  return pictures;
}

std::vector<int> times_of(const std::vector<Picture>& pictures) {
  std::vector<int> times;
  for (const Picture& picture : pictures) times.push_back(picture.width);
  return times;
}

TEST(Simultaneous, PairsWhatWasTakenTogether) {
  const auto a = taken_at({0, 20, 40, 60}), b = taken_at({3, 22, 61});
  for (const bool is_swapped : {false, true}) {
    const auto pairs = is_swapped ? simultaneous(b, a, kWindow) : simultaneous(a, b, kWindow);
    ASSERT_TRUE(pairs) << pairs.error().message;
    const auto& [reference, camera] = *pairs;
    EXPECT_THAT(times_of(is_swapped ? camera : reference), testing::ElementsAre(0, 20, 60));
    EXPECT_THAT(times_of(is_swapped ? reference : camera), testing::ElementsAre(3, 22, 61));
  }
}

TEST(Simultaneous, UsesEachPictureOnce) {
  const auto fast = taken_at({0, 10, 20, 30, 40}), slow = taken_at({0, 40});
  for (const bool is_swapped : {false, true}) {
    const auto pairs = is_swapped ? simultaneous(slow, fast, milliseconds(20))
                                  : simultaneous(fast, slow, milliseconds(20));
    ASSERT_TRUE(pairs) << pairs.error().message;
    for (const auto& pictures : {pairs->reference, pairs->camera}) {
      ASSERT_EQ(pictures.size(), 2U);
      EXPECT_NE(pictures[0].width, pictures[1].width);
    }
  }
}

TEST(Simultaneous, IsOfTheSameFrameSetsWithoutAWindow) {
  const auto pairs = simultaneous(taken_at({0, 20, 40, 80}), taken_at({20, 41, 60, 80}), {});
  ASSERT_TRUE(pairs) << pairs.error().message;
  EXPECT_THAT(times_of(pairs->reference), testing::ElementsAre(20, 80));
  EXPECT_THAT(times_of(pairs->camera), testing::ElementsAre(20, 80));
}

TEST(Simultaneous, RefusesWhatWasTakenAtOtherTimes) {
  const auto pairs = simultaneous(taken_at({0, 20}), taken_at({500, 520}), kWindow);
  ASSERT_FALSE(pairs);
  EXPECT_EQ(pairs.error().message, "the cameras took no pictures at the same moment");
}

/// A camera with a pose, and a registration of it by some degrees.
class RegisteredAlignment : public testing::Test {
 protected:
  RegisteredAlignment() : sought{{}, rig, align::by_outline(rig, rig.cameras.front()).value()} {
    registration.outline = *sought.camera.outline;
    registration.rotation = optics::rotation({3, -2, 1}) * sought.camera.registration;
  }

  /// The pixel that shows a direction after `alignment`.
  std::optional<optics::Vec2> shown(const CameraAlignment& alignment) const {
    optics::Rig aligned = rig;
    EXPECT_TRUE(apply({.cameras = {alignment}}, aligned));
    const auto ball = optics::ball_projection(aligned, aligned.cameras.front());
    EXPECT_TRUE(ball) << ball.error().message;
    return ball->pixel(optics::normalized(optics::Vec3{-0.4, -0.8, 0.3}));
  }

  const optics::Rig rig = tests::rig_with_pose({100, -540, 440});
  align::SoughtCamera sought;
  align::Registration registration;
};

TEST_F(RegisteredAlignment, KeepsAPoseThatTheRigStates) {
  const auto kept = registered_alignment(rig.cameras.front(), sought, registration);
  ASSERT_TRUE(kept) << kept.error().message;
  EXPECT_TRUE(kept->pose);
  EXPECT_FALSE(kept->outline);
  EXPECT_FALSE(kept->registration);
  const auto stated = registered_alignment(sought.camera, sought, registration);
  ASSERT_TRUE(stated) << stated.error().message;
  EXPECT_FALSE(stated->pose);
  EXPECT_TRUE(stated->outline);
  ASSERT_TRUE(stated->registration);
  const auto by_pose = shown(*kept), by_outline = shown(*stated);
  ASSERT_TRUE(by_pose && by_outline);
  EXPECT_NEAR(by_pose->u, by_outline->u, 0.02);
  EXPECT_NEAR(by_pose->v, by_outline->v, 0.02);
  const auto before = shown({.camera = rig.cameras.front().name});
  ASSERT_TRUE(before);
  EXPECT_GT(std::hypot(before->u - by_pose->u, before->v - by_pose->v), 1)
      << "the test would see that it was not turned";
}

TEST(RegisterCamera, ProposesThePoseOfACameraThatHasOne) {
  const auto pair = orbwatch::tests::camera_pair(501, false);
  const auto& truth = pair.room.second;
  // As if it stood elsewhere: turned about the ball, in the origin.
  const optics::Mat3 turn = align::rotation_about({0.3, -0.2, 0.5});
  optics::RigCamera stated = pair.sought;
  stated.outline.reset();
  stated.pose = optics::Pose{truth.axes * transposed(turn), turn * truth.position};
  const align::SimultaneousPictures pictures{{pair.reference().picture}, {pair.unknown().picture}};
  const auto found = register_camera(pair.rig, pair.known, stated, pictures, {}, {});
  ASSERT_TRUE(found) << found.error().message;
  const AlignmentProposal& proposal = found->proposal;
  EXPECT_EQ(proposal.alignment.camera, "B");
  ASSERT_TRUE(proposal.alignment.pose);
  EXPECT_FALSE(proposal.alignment.outline || proposal.alignment.registration);
  const optics::Pose& pose = *proposal.alignment.pose;
  EXPECT_LT(optics::degrees(align::angle_between(pose.rotation, truth.axes)), 0.2);
  EXPECT_LT(norm(pose.position - truth.position), 0.005 * norm(truth.position));
  EXPECT_EQ(proposal.method, "register by features");
  EXPECT_TRUE(proposal.quality.starts_with("residual ")) << proposal.quality;
  EXPECT_LT(proposal.direction_sigma, 1);
}

}  // namespace
}  // namespace orbwatch::app
