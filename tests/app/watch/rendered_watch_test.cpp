// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "app/watch/alignment_watch.h"
#include "tests/support/picture_of_mat.h"
#include "tests/support/reference_data.h"
#include "tests/support/rendered_scene.h"
#include "tests/support/rendered_sequence.h"
#include "tests/support/temporary_folder.h"

/// The watch of a camera of the rendered process that is bumped while orbwatchd is off.
namespace orbwatch::app {
namespace {

class RenderedWatch : public testing::Test {
 protected:
  void SetUp() override {
    ORBWATCH_REQUIRE_FILE(orbwatch::tests::rendered_pictures());
    sequence_.emplace("seq_bump");
    const cv::FileStorage file = orbwatch::tests::open_rendered_scene();
    bump_ = static_cast<int>(file["sequences"]["seq_bump"]["bump_frame"]);
    for (const auto& frame : sequence_->frames()) {
      frames_.push_back(
          cv::imread(frame.picture.string(), cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR));
    }
  }

  /// `size`: of the stated outline, relative to the true one.
  AlignmentWatch watch(std::uint32_t alignment = 1, double size = 1) const {
    optics::Outline stated = sequence_->camera().outline().value();
    stated.rx *= size;
    stated.ry *= size;
    const align::DriftSubject subject{frames_[0].cols, frames_[0].rows, stated, sequence_->camera(),
                                      std::nullopt};
    return AlignmentWatch::make("a", subject, {}, folder_.path(), alignment).value();
  }

  /// The figures after frames from `first` on, again and again, at 10 per second.
  CameraWatchStatus after(AlignmentWatch& watch, int pictures, int first, int end) {
    CameraWatchStatus figures;
    for (int n = 0; n < pictures; ++n) {
      now_ += std::chrono::milliseconds(100);
      const auto& frame = frames_[static_cast<std::size_t>(first + n % (end - first))];
      watch.observe(orbwatch::tests::picture_of_mat(frame), now_, figures);
    }
    return figures;
  }
  static OutlineCheck check_zero(AlignmentWatch& watch) {
    const auto zero = watch.take_zero_picture();
    EXPECT_TRUE(zero) << "no zero";
    if (!zero) return {};
    return check_outline(luminance_picture(zero->luminance, zero->format), zero->stated);
  }
  CameraWatchStatus before_bump(AlignmentWatch& watch, int pictures) {
    return after(watch, pictures, 0, bump_);
  }
  CameraWatchStatus after_bump(AlignmentWatch& watch, int pictures) {
    return after(watch, pictures, bump_, static_cast<int>(frames_.size()));
  }

  orbwatch::tests::TemporaryFolder folder_;
  hal::TimePoint now_{std::chrono::hours(1)};
  std::optional<orbwatch::tests::RenderedSequence> sequence_;
  int bump_ = 0;
  std::vector<cv::Mat> frames_;
};

TEST_F(RenderedWatch, ReportsABumpThatHappenedWhileItWasOff) {
  {
    AlignmentWatch watch = this->watch();
    EXPECT_EQ(before_bump(watch, 40).alignment, AlignmentLevel::Good);
  }
  AlignmentWatch watch = this->watch();
  const CameraWatchStatus seen = after_bump(watch, 1);
  EXPECT_EQ(seen.alignment, AlignmentLevel::Alarm) << "in the first picture";
  EXPECT_GT(seen.drift_error, 30) << "rendered_drift_test has the truth, 37 deg";
}

TEST_F(RenderedWatch, MeasuresAtOnceAfterARestart) {
  {
    AlignmentWatch watch = this->watch();
    before_bump(watch, 40);
  }
  AlignmentWatch watch = this->watch();
  const CameraWatchStatus seen = before_bump(watch, 1);
  EXPECT_EQ(seen.alignment, AlignmentLevel::Good);
  EXPECT_LT(seen.drift_error, 0.03);
}

TEST_F(RenderedWatch, AnOutlineThatIsRightIsAligned) {
  AlignmentWatch watch = this->watch();
  before_bump(watch, 20);
  EXPECT_FALSE(watch.take_zero_picture()) << "no zero yet";
  before_bump(watch, 20);
  const OutlineCheck seen = check_zero(watch);
  EXPECT_EQ(seen.state, OutlineState::Aligned);
  EXPECT_LT(seen.offset_percent, 1);
  EXPECT_FALSE(watch.take_zero_picture()) << "once";
}

/// Nothing moves, and yet the views are wrong.
TEST_F(RenderedWatch, AnOutlineThatIsFivePerCentWrongIsNotAlignedAlthoughNothingMoves) {
  for (const double size : {0.95, 1.05}) {
    const auto alignment = static_cast<std::uint32_t>(100 * size);
    {
      AlignmentWatch watch = this->watch(alignment, size);
      const CameraWatchStatus seen = before_bump(watch, 40);
      EXPECT_EQ(seen.alignment, AlignmentLevel::Good);
      EXPECT_LT(seen.drift_error, 0.03);
      const OutlineCheck check = check_zero(watch);
      EXPECT_EQ(check.state, OutlineState::NotAligned);
      EXPECT_NEAR(check.offset_percent, 5, 1);
      EXPECT_GT(check.offset_px, 3);
    }
    AlignmentWatch watch = this->watch(alignment, size);
    before_bump(watch, 1);
    EXPECT_EQ(check_zero(watch).state, OutlineState::NotAligned) << "after a restart";
  }
}

TEST_F(RenderedWatch, ANewAlignmentHasANewZero) {
  {
    AlignmentWatch watch = this->watch();
    before_bump(watch, 40);
  }
  AlignmentWatch watch = this->watch(2);
  EXPECT_EQ(before_bump(watch, 20).alignment, AlignmentLevel::Learning);
  EXPECT_EQ(before_bump(watch, 20).alignment, AlignmentLevel::Good);
}

}  // namespace
}  // namespace orbwatch::app
