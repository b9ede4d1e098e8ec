// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/dispatch.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "app/daemon/alignment_record.h"
#include "tests/app/pipeline/hand_camera.h"
#include "tests/app/pipeline/measurement/measured_recipe.h"
#include "tests/app/pipeline/views/thermal_view.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::daemon {
namespace {

using std::chrono::seconds;

/// Camera that can also be triggered to expose.
class TriggeredCamera : public pipeline::HandCamera {
 public:
  explicit TriggeredCamera(std::string name) : HandCamera(std::move(name), PixelFormat::Y16) {}
  Result<> trigger() override {
    ++triggers;
    return {};
  }
  std::atomic<int> triggers{0};
};

class ResultSink : public Sink {
 public:
  Result<> start() override { return {}; }
  void stop() override {}
  void accept(const ViewPtr&) override {}
  void accept(const Status& status) override {
    const std::lock_guard lock(mutex_);
    status_ = status;
    changed_.notify_all();
  }
  Status wait_for_set(std::uint64_t number) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, seconds(30), [&] { return status_.frame_set >= number; }));
    return status_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  Status status_;
};

class Dispatch : public testing::Test {
 protected:
  /// Starts cameras with these trigger modes; commands are the source of every trigger.
  void start(const std::vector<hal::TriggerMode>& modes) {
    LineSettings pulse;
    pulse.name = "pulse";
    pulse.use = LineUse::TriggerOut;
    pulse.back_end = LineKind::Simulated;
    pulse.wire.address.name = "OUT";
    lines = std::make_unique<Lines>(std::vector{pulse});
    pipeline::PipelinePlan plan;
    for (const hal::TriggerMode mode : modes) {
      auto camera = std::make_unique<TriggeredCamera>("camera " + std::to_string(cameras.size()));
      plan.formats.push_back(camera->configure({}).value());
      hal::TriggerSettings settings;
      settings.mode = mode;
      plan.triggers.push_back(lines->trigger(settings, kSoftwareSource, *camera));
      cameras.push_back(camera.get());
      plan.cameras.push_back(std::move(camera));
    }
    plan.deadline = seconds(20);
    plan.sync.window = plan.sync.max_wait = std::chrono::milliseconds(1);
    plan.recipes.push_back(
        compiled(recipe_plan(pipeline::thermal_view(0, "measured"), 30000, 0.04)));
    plan.view_count = 1;
    pipeline.emplace(std::move(plan));
    ASSERT_TRUE(lines->start());
    ASSERT_TRUE(pipeline->start({&sink, lines.get()}));
  }
  void TearDown() override {
    if (pipeline) pipeline->stop();
    if (lines) lines->stop();
  }

  CommandResult command(CommandCode code, double argument = 0) {
    return dispatch({code, {argument}},
                    {*pipeline, *lines, snapshots ? &*snapshots : nullptr,
                     recorder ? &*recorder : nullptr, watch, alignment, restart()});
  }
  Restart restart() {
    return {[this]() -> Result<> {
              if (may_restart) return {};
              return fail("the files are wrong");
            },
            [this] { ++restarts; }};
  }
  /// Exposes a frame that becomes a set.
  Status next_set(std::size_t camera = 0) {
    cameras[camera]->expose(40000);
    return sink.wait_for_set(++sets);
  }
  void wait_for_trigger(std::size_t camera, int number) {
    const auto end = std::chrono::steady_clock::now() + seconds(30);
    while (cameras[camera]->triggers < number && std::chrono::steady_clock::now() < end) {
      std::this_thread::yield();
    }
    ASSERT_EQ(cameras[camera]->triggers, number);
  }
  void wait_until_paces(std::size_t camera) {
    const auto end = std::chrono::steady_clock::now() + seconds(30);
    while (pipeline->pacing_camera() != camera && std::chrono::steady_clock::now() < end) {
      std::this_thread::yield();
    }
    ASSERT_EQ(pipeline->pacing_camera(), camera);
  }

  ResultSink sink;
  std::optional<pipeline::Pipeline> pipeline;  // outlives the lines, which trigger its cameras
  std::unique_ptr<Lines> lines;
  std::vector<TriggeredCamera*> cameras;
  orbwatch::tests::TemporaryFolder folder;
  std::optional<SnapshotSink> snapshots;
  std::optional<RecorderSink> recorder;
  std::uint64_t sets = 0;
  int restarts = 0;
  bool may_restart = true;
  const files::Resolved site{};  // without cameras
  const AlignedSite aligned{};
  AlignmentRecord accepted{site};
  CameraWatch watch{aligned, folder.path(), hal::SharedThreads::alone()};
  AlignmentDesk alignment{aligned, watch, accepted, [this] { ++restarts; },
                          [](const auto&) { return Result<>(); }};
};

TEST_F(Dispatch, ATriggerMakesAResultOfTheNextSetOfAFreeCamera) {
  start({hal::TriggerMode::Off});
  EXPECT_EQ(next_set().result, 0U);
  ASSERT_EQ(command(CommandCode::Trigger), CommandResult::Done);
  EXPECT_EQ(command(CommandCode::Trigger), CommandResult::Busy);
  EXPECT_EQ(next_set().result, 1U);
  EXPECT_EQ(next_set().result, 1U);
}

TEST_F(Dispatch, ATriggerAsksTheCameraThatIsTriggeredForItsFrame) {
  start({hal::TriggerMode::Software});
  cameras[0]->expose(40000);  // not requested: it is in no set
  for (int n = 1; n <= 3; ++n) {
    ASSERT_EQ(command(CommandCode::Trigger), CommandResult::Done);
    wait_for_trigger(0, n);
    const Status status = next_set();
    EXPECT_EQ(status.result, static_cast<std::uint64_t>(n));
    EXPECT_EQ(status.trigger, static_cast<std::uint64_t>(n));
    EXPECT_EQ(status.cameras[0].missed, 0U);
  }
}

TEST_F(Dispatch, ATriggerIsTheEdgeOfALine) {
  start({hal::TriggerMode::Line});
  ASSERT_EQ(command(CommandCode::Trigger), CommandResult::Done);
  EXPECT_EQ(next_set().result, 1U);
  EXPECT_EQ(cameras[0]->triggers, 0) << "it sees the edge itself or runs freely";
}

TEST_F(Dispatch, ATriggerOfAnotherCameraIsAResultOfTheOneThatPaces) {
  start({hal::TriggerMode::Off, hal::TriggerMode::Software});
  ASSERT_EQ(command(CommandCode::Trigger), CommandResult::Done);
  wait_for_trigger(1, 1);
  EXPECT_EQ(next_set().result, 1U);
  EXPECT_EQ(next_set().result, 1U);
}

TEST_F(Dispatch, ATriggerIsAResultOfTheFreeCameraThatPacesForATriggeredOne) {
  start({hal::TriggerMode::Software, hal::TriggerMode::Off});
  cameras[0]->fail_with(hal::Fault::Unplugged);
  ASSERT_EQ(command(CommandCode::Trigger), CommandResult::Done);
  EXPECT_EQ(next_set(1).result, 1U);
  EXPECT_EQ(next_set(1).result, 1U);
}

TEST_F(Dispatch, ATriggerEndsWithTheSetOfTheTriggeredCameraThatPacesInstead) {
  start({hal::TriggerMode::Off, hal::TriggerMode::Software});
  ASSERT_EQ(command(CommandCode::Trigger), CommandResult::Done);
  wait_for_trigger(1, 1);
  cameras[0]->fail_with(hal::Fault::Unplugged);
  wait_until_paces(1);
  EXPECT_EQ(next_set(1).result, 1U);
  cameras[0]->fail_with(hal::Fault::None);
  wait_until_paces(0);
  EXPECT_EQ(command(CommandCode::Trigger), CommandResult::Done) << "none is pending";
  EXPECT_EQ(next_set(0).result, 2U);
}

TEST_F(Dispatch, ATriggerIsAResultOfTheCameraThatPacesForASilentOne) {
  start({hal::TriggerMode::Off, hal::TriggerMode::Software});
  for (int n = 0; n < 3; ++n) next_set();
  wait_until_paces(1);
  for (int n = 1; n <= 2; ++n) {
    ASSERT_EQ(command(CommandCode::Trigger), CommandResult::Done);
    wait_for_trigger(1, n);
    EXPECT_EQ(next_set(1).result, static_cast<std::uint64_t>(n));
  }
}

TEST_F(Dispatch, PulsesGoToTheLines) {
  start({hal::TriggerMode::Off});
  EXPECT_EQ(command(CommandCode::Pulse, 0), CommandResult::Done);
  EXPECT_EQ(command(CommandCode::Pulse, 1), CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(command(CommandCode::Pulse, 65535), CommandResult::ArgumentOutOfRange);
}

TEST_F(Dispatch, SnapshotsNeedAFolderAndAView) {
  start({hal::TriggerMode::Off});
  EXPECT_EQ(command(CommandCode::Snapshot), CommandResult::NotPossible);
  snapshots.emplace(SnapshotSettings{folder.path(), 1});
  EXPECT_EQ(command(CommandCode::Snapshot, 1), CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(command(CommandCode::Snapshot, 0), CommandResult::NotPossible) << "not live yet";
  snapshots->accept(next_set());
  EXPECT_EQ(command(CommandCode::Snapshot, 0), CommandResult::Done);
  EXPECT_EQ(command(CommandCode::Snapshot, 0), CommandResult::Busy);
}

TEST_F(Dispatch, ARestartIsAskedForOnce) {
  start({hal::TriggerMode::Off});
  EXPECT_EQ(command(CommandCode::Restart), CommandResult::Done);
  EXPECT_EQ(restarts, 1);
}

TEST_F(Dispatch, ARestartThatTheFilesDoNotPermitIsRefused) {
  start({hal::TriggerMode::Off});
  may_restart = false;
  EXPECT_EQ(command(CommandCode::Restart), CommandResult::NotPossible);
  EXPECT_EQ(restarts, 0);
}

TEST_F(Dispatch, AllElseGoesToThePipeline) {
  start({hal::TriggerMode::Off});
  EXPECT_EQ(command(CommandCode::SelectView, 0), CommandResult::Done);
  EXPECT_EQ(command(CommandCode::SelectView, 1), CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(command(CommandCode::SelectRecipe, 1), CommandResult::Done);
  EXPECT_EQ(command(CommandCode::SelectRecipe, 2), CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(command(CommandCode::PointView, 0), CommandResult::NotPossible) << "it is measured";
  EXPECT_EQ(command(CommandCode::Stop), CommandResult::Done);
  EXPECT_EQ(next_set().state, SystemState::Stopped);
  EXPECT_EQ(command(CommandCode::Start), CommandResult::Done);
  EXPECT_EQ(command(CommandCode::SetProcessActive, 1), CommandResult::Done);
  EXPECT_EQ(command(CommandCode::AcknowledgeAlarm, 0), CommandResult::Done);
}

TEST_F(Dispatch, RecordsAnEventOnlyWherePicturesWait) {
  start({hal::TriggerMode::Off});
  EXPECT_EQ(command(CommandCode::RecordEvent), CommandResult::NotPossible);
  RecorderSettings settings{.folder = folder.path()};
  recorder.emplace(settings, StatusNames{}, RecordedTexts{});
  EXPECT_EQ(command(CommandCode::RecordEvent), CommandResult::NotPossible) << "it has no ring";
  settings.events.emplace().ring_mib = 1;
  recorder.emplace(settings, StatusNames{}, RecordedTexts{});
  EXPECT_EQ(command(CommandCode::RecordEvent), CommandResult::Done);
}

TEST_F(Dispatch, AlignsNoCameraThatIsNotThere) {
  start({hal::TriggerMode::Off});
  for (const CommandCode code :
       {CommandCode::DetectBall, CommandCode::RegisterCamera, CommandCode::CorrectAlignment,
        CommandCode::AcceptAlignment, CommandCode::DiscardAlignment, CommandCode::LearnCleanBall,
        CommandCode::MarkPoint, CommandCode::ForgetPoints, CommandCode::PlaceCamera,
        CommandCode::CancelAlignment}) {
    EXPECT_EQ(command(code), CommandResult::ArgumentOutOfRange);
  }
  EXPECT_EQ(restarts, 0);
}

}  // namespace
}  // namespace orbwatch::app::daemon
