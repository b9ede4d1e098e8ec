// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/alignment_desk.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "app/alignment/found_outline.h"
#include "proc/align/rotation_fit.h"
#include "tests/app/alignment/rig_with_pose.h"
#include "tests/support/picture_of_mat.h"

namespace orbwatch::app {
namespace {

using orbwatch::tests::picture_of_mat;

/// Watched cameras that deliver one picture again and again, and can be told to deliver none.
class OnePicture : public WatchedCameras {
 public:
  explicit OnePicture(cv::Mat picture) : picture_(std::move(picture)) {}

  bool is_watched(std::size_t /*camera*/) const override { return true; }
  hal::Fault fault(std::size_t /*camera*/) const override { return faulted; }
  std::optional<align::DriftState> drift(std::size_t /*camera*/) const override { return drifted; }
  void ask(std::size_t /*camera*/, std::function<void(RecordedPicture)> reader) override {
    reader(copied(picture_of_mat(picture_), {}));
  }
  void ask_together(std::vector<std::size_t> cameras,
                    std::function<void(Result<std::vector<RecordedPicture>>)> reader) override {
    std::vector<RecordedPicture> pictures;
    for (std::size_t n = 0; n < cameras.size(); ++n) {
      pictures.push_back(copied(picture_of_mat(picture_), {}));
    }
    reader(std::move(pictures));
  }
  Result<std::vector<std::vector<RecordedPicture>>> record(
      const std::vector<std::size_t>& cameras, std::size_t count, std::chrono::seconds /*patience*/,
      const align::WorkProgress& progress) override {
    if (auto wanted = progress.at(align::WorkStep::Record, 0.25); !wanted) {
      return tl::unexpected(wanted.error());
    }
    {
      std::unique_lock lock(mutex_);
      ++waiting_;
      changed_.notify_all();
      const auto delivers = [&] { return delivers_; };
      // A computation that does not end at once ignores its cancellation, too.
      if (!is_deaf) changed_.wait(lock, progress.stop(), delivers);
      if (is_deaf) changed_.wait(lock, delivers);
      if (!delivers_) return fail("cancelled");
    }
    std::vector<std::vector<RecordedPicture>> records(cameras.size());
    for (auto& record : records) {
      for (std::size_t n = 0; n < count; ++n) {
        record.push_back(copied(picture_of_mat(picture_), std::chrono::seconds(n)));
      }
    }
    return records;
  }
  const std::shared_ptr<hal::SharedThreads>& threads() const override { return threads_; }

  void set_delivers(bool delivers) {
    const std::lock_guard lock(mutex_);
    delivers_ = delivers;
    changed_.notify_all();
  }
  /// Returns once record() was called `count` times.
  void wait_for_calls(int count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return waiting_ >= count; });
  }

  bool is_deaf = false;  ///< set before the first call
  std::optional<align::DriftState> drifted;
  hal::Fault faulted = hal::Fault::None;

 private:
  cv::Mat picture_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool delivers_ = true;
  int waiting_ = 0;  ///< calls of record()
  const std::shared_ptr<hal::SharedThreads> threads_ = hal::SharedThreads::alone();
};

class KeptEntries : public AcceptedAlignments {
 public:
  Result<int> add(CalibrationEntry entry) override {
    entries.push_back(std::move(entry));
    return static_cast<int>(entries.size());
  }
  Result<std::optional<CalibrationEntry>> before(const std::string& /*camera*/) const override {
    return std::optional<CalibrationEntry>();
  }
  bool is_young(const std::string& /*camera*/, std::chrono::minutes /*age*/) const override {
    return false;
  }

  std::vector<CalibrationEntry> entries;
};

cv::Mat noise_of(int height, int width) {
  cv::Mat noise(height, width, CV_8U);
  cv::theRNG().state = 5;
  cv::randn(noise, 120, 30);
  return noise;
}

class AlignmentDeskTest : public testing::Test {
 protected:
  AlignmentDeskTest() {
    site.rig = tests::rig_with_pose({100, -540, 440});
    site.cameras.push_back({"a", 0, {}});
    desk.emplace(
        site, watch, accepted, [this] { ++restarts; }, [](const auto&) { return Result<>(); });
  }

  AlignmentReport report_after_work() {
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    AlignmentReport report = desk->report(0);
    while (report.state == ProposalState::Working && std::chrono::steady_clock::now() < give_up) {
      std::this_thread::yield();
      report = desk->report(0);
    }
    return report;
  }

  const cv::Mat noise = noise_of(300, 400);
  OnePicture watch{noise};
  KeptEntries accepted;
  AlignedSite site;
  int restarts = 0;
  std::optional<AlignmentDesk> desk;
};

TEST_F(AlignmentDeskTest, RefusesAnUnsureBallInTheWordingOfEveryCommand) {
  ASSERT_EQ(desk->detect(0), CommandResult::Done);
  const AlignmentReport report = report_after_work();
  EXPECT_EQ(report.state, ProposalState::Refused);
  const auto found = found_outline(picture_of_mat(noise));
  ASSERT_FALSE(found);
  EXPECT_EQ(report.refusal, found.error().message);
  EXPECT_EQ(desk->accept(0), CommandResult::NotPossible);
  EXPECT_TRUE(accepted.entries.empty());
}

TEST_F(AlignmentDeskTest, ACancelledSearchEndsAndLeavesWhatWasBefore) {
  const optics::Vec2 centre = desk->report(0).in_force->outline.centre;
  ASSERT_EQ(desk->move_outline(0, {centre.u + 3, centre.v}), CommandResult::Done);
  watch.set_delivers(false);
  ASSERT_EQ(desk->detect(0), CommandResult::Done);
  watch.wait_for_calls(1);
  EXPECT_EQ(desk->report(0).state, ProposalState::Working);
  EXPECT_EQ(desk->report(0).step, align::WorkStep::Record);
  EXPECT_EQ(desk->report(0).share, 0.25);
  EXPECT_EQ(desk->detect(0), CommandResult::Busy);
  ASSERT_EQ(desk->cancel(0), CommandResult::Done);
  const AlignmentReport report = desk->report(0);
  EXPECT_EQ(report.state, ProposalState::Ready);
  EXPECT_EQ(report.step, align::WorkStep::None);
  EXPECT_EQ(report.steps, 1U);
  EXPECT_EQ(report.refusal, "");
  EXPECT_NEAR(report.proposed->outline.centre.u, centre.u + 3, 1e-9);
  EXPECT_EQ(desk->cancel(0), CommandResult::NotPossible);
  EXPECT_EQ(desk->cancel(1), CommandResult::ArgumentOutOfRange);
  // The next one is accepted at once, and works.
  ASSERT_EQ(desk->detect(0), CommandResult::Done);
  watch.wait_for_calls(2);
  watch.set_delivers(true);
  EXPECT_EQ(report_after_work().refusal, found_outline(picture_of_mat(noise)).error().message);
}

TEST_F(AlignmentDeskTest, NothingIsKeptOfACancelledSearchThatEndsLater) {
  watch.is_deaf = true;
  watch.set_delivers(false);
  ASSERT_EQ(desk->mark(0, {1, 2, 3}), CommandResult::Done);
  watch.wait_for_calls(1);
  ASSERT_EQ(desk->cancel(0), CommandResult::Done);
  const optics::Vec2 centre = desk->report(0).in_force->outline.centre;
  ASSERT_EQ(desk->pick(0, {centre.u + 10, centre.v}), CommandResult::Done);
  ASSERT_EQ(desk->mark(0, {4, 5, 6}), CommandResult::Done) << "accepted while the other one ends";
  watch.set_delivers(true);
  const AlignmentReport report = report_after_work();
  EXPECT_EQ(report.state, ProposalState::None);
  EXPECT_EQ(report.refusal, "");
  ASSERT_EQ(report.points.size(), 1U);
  EXPECT_EQ(report.points[0].point.x, 4);
}

TEST_F(AlignmentDeskTest, ForgetsOnePointByItsCoordinates) {
  ASSERT_TRUE(desk->report(0).in_force);
  const optics::Vec2 centre = desk->report(0).in_force->outline.centre;
  for (const double x : {10.5, 20.25, 30.0}) {
    ASSERT_EQ(desk->pick(0, {centre.u + x, centre.v}), CommandResult::Done);
    ASSERT_EQ(desk->mark(0, {x, 2, 3}), CommandResult::Done);
    ASSERT_EQ(report_after_work().refusal, "");
  }
  EXPECT_EQ(desk->forget_point(0, {20.25, 2, 4}), CommandResult::NotPossible);
  ASSERT_EQ(desk->forget_point(0, {20.25, 2, 3}), CommandResult::Done);
  const std::vector<PlacedPoint> points = desk->report(0).points;
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].point.x, 10.5);
  EXPECT_EQ(points[1].point.x, 30);
  EXPECT_EQ(desk->forget_point(0, {20.25, 2, 3}), CommandResult::NotPossible);
  EXPECT_EQ(desk->forget_point(1, {10.5, 2, 3}), CommandResult::ArgumentOutOfRange);
}

TEST_F(AlignmentDeskTest, StatesTheErrorAtTheWorkPiece) {
  site.work_distance = 400;
  watch.drifted.emplace();
  watch.drifted->level = align::DriftLevel::Warning;
  watch.drifted->outline = desk->report(0).in_force->outline;
  watch.drifted->cause = align::DriftCause::BallMoved;
  watch.drifted->direction_sigma = optics::degrees(0.005);
  ASSERT_EQ(desk->correct(0), CommandResult::Done);
  const AlignmentReport report = report_after_work();
  ASSERT_TRUE(report.proposed) << report.refusal;
  // The error of the alignment in force, 0.3 deg, and that of the drift.
  EXPECT_NEAR(report.proposed->work_sigma, 400 * std::hypot(optics::radians(0.3), 0.005), 1e-9);
  EXPECT_TRUE(report.proposed->quality.ends_with(
      "sigma 0.41 deg, of that 0.29 deg by the drift, at the work piece 2.90 mm, below 5.01 mm in "
      "19 of 20 alignments"))
      << report.proposed->quality;
  ASSERT_EQ(desk->accept(0), CommandResult::Done);
  EXPECT_EQ(accepted.entries.at(0).quality, report.proposed->quality);
}

TEST_F(AlignmentDeskTest, StatesNoErrorOfACorrectionWhoseCauseIsUnknown) {
  site.work_distance = 400;
  watch.drifted.emplace();
  watch.drifted->level = align::DriftLevel::Warning;
  watch.drifted->outline = desk->report(0).in_force->outline;
  watch.drifted->direction_sigma = 0.02;
  ASSERT_EQ(desk->correct(0), CommandResult::Done);
  const AlignmentReport report = report_after_work();
  ASSERT_TRUE(report.proposed) << report.refusal;
  EXPECT_FALSE(signals::is_valid(report.proposed->direction_sigma));
  EXPECT_FALSE(signals::is_valid(report.proposed->work_sigma));
  EXPECT_NE(report.proposed->quality.find("sigma unknown"), std::string::npos)
      << report.proposed->quality;
}

void expect_same_place(const AlignmentReport& a, const AlignmentReport& b) {
  ASSERT_TRUE(a.proposed && b.proposed) << a.refusal << b.refusal;
  EXPECT_NEAR(a.proposed->outline.centre.u, b.proposed->outline.centre.u, 1e-6);
  EXPECT_NEAR(a.proposed->outline.centre.v, b.proposed->outline.centre.v, 1e-6);
  EXPECT_NEAR(a.proposed->rotation.yaw, b.proposed->rotation.yaw, 1e-6);
  EXPECT_NEAR(a.proposed->rotation.pitch, b.proposed->rotation.pitch, 1e-6);
  EXPECT_NEAR(a.proposed->rotation.roll, b.proposed->rotation.roll, 1e-6);
}

/// The drift is measured against the alignment in force, whatever is proposed.
TEST_F(AlignmentDeskTest, CorrectsADriftOnceHoweverOftenItIsAskedTo) {
  watch.drifted.emplace();
  watch.drifted->level = align::DriftLevel::Warning;
  watch.drifted->turn = align::rotation_about({0.004, -0.002, 0.01});
  watch.drifted->outline = desk->report(0).in_force->outline;
  ASSERT_EQ(desk->correct(0), CommandResult::Done);
  const AlignmentReport once = report_after_work();
  ASSERT_EQ(desk->correct(0), CommandResult::Done);
  const AlignmentReport twice = report_after_work();
  EXPECT_EQ(twice.steps, 2U);
  expect_same_place(twice, once);
  // After a step that is right already, and after one that is not.
  ASSERT_EQ(desk->turn(0, {0, 0, 0}), CommandResult::Done);
  expect_same_place(desk->report(0), once);
  ASSERT_EQ(desk->correct(0), CommandResult::Done);
  expect_same_place(report_after_work(), once);
  ASSERT_EQ(desk->turn(0, {5, 0, 0}), CommandResult::Done);
  ASSERT_EQ(desk->correct(0), CommandResult::Done);
  expect_same_place(report_after_work(), once);
}

TEST_F(AlignmentDeskTest, ACorrectionOfACameraWithAFaultIsRefusedWithTheFault) {
  watch.drifted.emplace();
  watch.drifted->level = align::DriftLevel::Warning;
  watch.drifted->outline = desk->report(0).in_force->outline;
  watch.faulted = hal::Fault::Unplugged;
  ASSERT_EQ(desk->correct(0), CommandResult::Done);
  const AlignmentReport report = report_after_work();
  EXPECT_EQ(report.state, ProposalState::Refused);
  EXPECT_EQ(report.refusal,
            "there is no picture: " + std::string(operator_text(hal::Fault::Unplugged)));
  EXPECT_FALSE(report.proposed);
}

TEST_F(AlignmentDeskTest, PutsAStatedAlignmentInForceByTheRecordAndARestart) {
  ASSERT_TRUE(desk->report(0).in_force);
  const optics::Vec2 centre = desk->report(0).in_force->outline.centre;
  ASSERT_EQ(desk->move_outline(0, {centre.u + 3, centre.v}), CommandResult::Done);
  ASSERT_EQ(desk->accept(0), CommandResult::Done);
  ASSERT_EQ(accepted.entries.size(), 1U);
  EXPECT_EQ(accepted.entries[0].method, "outline by hand");
  EXPECT_EQ(camera_of(accepted.entries[0]).camera, "a");
  EXPECT_NEAR(camera_of(accepted.entries[0]).outline->centre.u, centre.u + 3, 1e-9);
  EXPECT_EQ(restarts, 1);
  EXPECT_FALSE(desk->report(0).proposed);
}

}  // namespace
}  // namespace orbwatch::app
