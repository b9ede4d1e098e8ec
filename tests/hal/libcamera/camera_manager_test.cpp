// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/camera_manager.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

namespace orbwatch::hal {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::vector<ListedCamera> kCameras{{"/base/soc/i2c0mux/i2c@1/imx219@10", "imx219"},
                                         {"/base/soc/i2c0mux/i2c@0/imx219@10", "imx219"},
                                         {"/base/soc/i2c0mux/i2c@0/ov9281@60", "ov9281"},
                                         {"platform/vimc.0 Sensor B", "Sensor B"},
                                         {"platform/vimc.0 Sensor B2", "Sensor B2"}};

TEST(ChooseCamera, TakesAWholeIdOrAPartThatOnlyOneHas) {
  EXPECT_EQ(choose_camera(kCameras, "ov9281").value_or(""), kCameras[2].id);
  EXPECT_EQ(choose_camera(kCameras, "i2c@1").value_or(""), kCameras[0].id);
  EXPECT_EQ(choose_camera(kCameras, "Sensor B2").value_or(""), kCameras[4].id);
  EXPECT_EQ(choose_camera(kCameras, "platform/vimc.0 Sensor B").value_or(""), kCameras[3].id)
      << "also a part of another id";
  EXPECT_EQ(choose_camera({kCameras[1]}, "").value_or(""), kCameras[1].id) << "the only one";
}

TEST(ChooseCamera, ListsWhatCouldBeMeant) {
  const auto several = choose_camera(kCameras, "imx219");
  ASSERT_FALSE(several);
  EXPECT_THAT(several.error().message,
              AllOf(HasSubstr("\"imx219\""), HasSubstr("i2c@1/imx219@10\" (imx219)"),
                    HasSubstr("i2c@0/imx219@10"), testing::Not(HasSubstr("ov9281"))));
  const auto missing = choose_camera(kCameras, "imx708");
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message, AllOf(HasSubstr("imx708"), HasSubstr("(ov9281)")));
  const auto none = choose_camera({}, "imx708");
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("there are: none"));
  EXPECT_FALSE(choose_camera({}, ""));
}

TEST(CameraManager, IsOneForAllThreadsAndStartsAgainAfterItsLastShare) {
  for (int round = 0; round < 3; ++round) {
    std::vector<std::shared_ptr<libcamera::CameraManager>> shares(4);
    std::vector<std::thread> threads;
    threads.reserve(shares.size());
    for (auto& share : shares) {
      threads.emplace_back([&share] { share = camera_manager().value_or(nullptr); });
    }
    for (auto& thread : threads) thread.join();
    ASSERT_NE(shares[0], nullptr);
    for (const auto& share : shares) EXPECT_EQ(share, shares[0]);
  }
}

}  // namespace
}  // namespace orbwatch::hal
