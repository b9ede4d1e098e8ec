// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/alignment_finder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "proc/align/rotation_fit.h"
#include "tests/proc/align/register/camera_pair.h"

namespace orbwatch::app {
namespace {

/// Two watched cameras, each of which delivers one picture.
class TwoPictures : public WatchedCameras {
 public:
  explicit TwoPictures(std::vector<Picture> pictures) : pictures_(std::move(pictures)) {}

  bool is_watched(std::size_t /*camera*/) const override { return true; }
  hal::Fault fault(std::size_t /*camera*/) const override { return hal::Fault::None; }
  std::optional<align::DriftState> drift(std::size_t /*camera*/) const override { return {}; }
  void ask(std::size_t /*camera*/, std::function<void(RecordedPicture)> /*reader*/) override {}
  void ask_together(std::vector<std::size_t> /*cameras*/,
                    std::function<void(Result<std::vector<RecordedPicture>>)> /*reader*/) override {
  }
  Result<std::vector<std::vector<RecordedPicture>>> record(
      const std::vector<std::size_t>& cameras, std::size_t /*count*/,
      std::chrono::seconds /*patience*/, const align::WorkProgress& /*progress*/) override {
    std::vector<std::vector<RecordedPicture>> records(cameras.size());
    for (std::size_t n = 0; n < cameras.size(); ++n) {
      records[n].push_back(copied(pictures_[cameras[n]], {}));
    }
    return records;
  }
  const std::shared_ptr<hal::SharedThreads>& threads() const override { return threads_; }

 private:
  std::vector<Picture> pictures_;
  const std::shared_ptr<hal::SharedThreads> threads_ = hal::SharedThreads::alone();
};

/// A site of two colour cameras of one simulated room, of which the second one is to be registered.
class RegisteredByThePage : public testing::Test {
 protected:
  RegisteredByThePage() {
    site.rig = pair.rig;
    site.rig.cameras = {pair.known, pair.sought};
    site.cameras = {{pair.known.name, 0, {}}, {pair.sought.name, 1, {}}};
  }

  Result<Found> found() {
    const AlignmentFinder finder(site, watch);
    return finder.register_to_first(site.rig, 1, {});
  }

  const orbwatch::tests::CameraPair pair = orbwatch::tests::camera_pair(501, false);
  TwoPictures watch{{pair.reference().picture, pair.unknown().picture}};
  AlignedSite site;
};

TEST_F(RegisteredByThePage, RefinesAnOutlineThatIsOff) {
  const optics::Outline truth = *pair.sought.outline;
  optics::Outline& stated = *site.rig.cameras[1].outline;
  stated.centre.u += 0.01 * truth.rx;
  stated.rx *= 1.01;
  stated.ry *= 1.01;
  const auto registered = found();
  ASSERT_TRUE(registered) << registered.error().message;
  const CameraAlignment& alignment = registered->proposal->alignment;
  ASSERT_TRUE(alignment.outline && alignment.registration);
  EXPECT_NEAR(alignment.outline->centre.u, truth.centre.u, 0.004 * truth.rx);
  EXPECT_NEAR(alignment.outline->rx, truth.rx, 0.004 * truth.rx);
  EXPECT_LT(optics::degrees(align::angle_between(*alignment.registration, pair.truth)), 0.4);
}

TEST_F(RegisteredByThePage, KeepsTheBallWhereAMeasuredPoseShowsIt) {
  const auto& truth = pair.room.second;
  optics::RigCamera& stated = site.rig.cameras[1];
  stated.outline.reset();
  stated.pose = optics::Pose{truth.axes, truth.position};
  const auto registered = found();
  ASSERT_TRUE(registered) << registered.error().message;
  const CameraAlignment& alignment = registered->proposal->alignment;
  ASSERT_TRUE(alignment.pose);
  // The ball is in the origin.
  const optics::Vec3 ball = alignment.pose->rotation * alignment.pose->position;
  EXPECT_LT(norm(ball - truth.axes * truth.position), 1e-5 * norm(truth.position));
}

}  // namespace
}  // namespace orbwatch::app
