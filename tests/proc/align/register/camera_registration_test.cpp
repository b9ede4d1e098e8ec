// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/camera_registration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stop_token>
#include <vector>

#include "proc/align/rotation_fit.h"
#include "tests/proc/align/register/camera_pair.h"

namespace orbwatch::align {
namespace {

using tests::camera_pair;

/// Registers a second camera of either kind, and keeps what a user would be told.
class FollowedRegistration : public testing::TestWithParam<bool> {
 protected:
  Result<CameraRegistration> run(double cancelled_at) {
    const auto pair = camera_pair(501, GetParam());
    SoughtCamera sought = pair.unknown();
    // Edges need a start nearby.
    sought.camera.registration = rotation_about({0.03, -0.02, 0.04}) * pair.truth;
    const WorkProgress progress(
        [&](WorkStep step, double share) {
          steps.push_back(step);
          shares.push_back(share);
          if (share >= cancelled_at) stop.request_stop();
        },
        stop.get_token());
    return register_camera({{pair.reference().picture}, {sought.picture}}, pair.reference().ball,
                           sought, RegistrationMethod::Auto, progress);
  }

  std::stop_source stop;
  std::vector<WorkStep> steps;
  std::vector<double> shares;
};
INSTANTIATE_TEST_SUITE_P(ColourAndThermal, FollowedRegistration, testing::Bool());

TEST_P(FollowedRegistration, TellsHowFarItIs) {
  constexpr double kNever = 2;
  const auto found = run(kNever);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_THAT(steps, testing::Each(GetParam() ? WorkStep::Edges : WorkStep::Features));
  EXPECT_GE(shares.size(), 4U);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_EQ(shares.front(), 0);
  EXPECT_GE(shares.back(), 0.5);
  EXPECT_LT(shares.back(), 1);
}

TEST_P(FollowedRegistration, EndsBeforeTheNextStepWhenItIsCancelled) {
  const auto found = run(0.2);
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().message, testing::StartsWith("cancelled"));
  EXPECT_EQ(std::ranges::count_if(shares, [](double share) { return share >= 0.2; }), 1);
}

}  // namespace
}  // namespace orbwatch::align
