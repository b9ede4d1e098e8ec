// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <memory>

#include "app/pipeline/pipeline.h"
#include "hal/lines/frame_trigger.h"
#include "tests/app/pipeline/pipeline_case.h"

namespace orbwatch::app::pipeline {
namespace {

class TriggeredPipeline : public PipelineTest {
 protected:
  std::shared_ptr<hal::FrameTrigger> trigger_first_camera() {
    auto trigger = std::make_shared<hal::FrameTrigger>(
        hal::TriggerSettings{.mode = hal::TriggerMode::Line}, nullptr);
    plan.triggers = {trigger, nullptr};
    return trigger;
  }
};

TEST_F(TriggeredPipeline, ATriggeredCameraGivesOneFrameForEachTriggerAndTheRestIsMissed) {
  const auto trigger = trigger_first_camera();
  start();
  constexpr std::uint64_t kTriggers = 12;
  std::uint64_t frames = 0;
  for (std::uint64_t i = 1; i <= kTriggers; ++i) {
    trigger->on_edge({hal::Edge::Rising, hal::Clock::now()});
    if (i % 3 == 1) continue;  // the next edge comes before the camera exposes
    cameras[0]->expose(40000);
    cameras[0]->expose(40000);  // without a trigger: in no set
    ++frames;
    sink.wait_for([&](const Status& s) { return s.frame_set == frames; });
  }
  const Status status =
      sink.wait_for([&](const Status& s) { return s.cameras[0].triggers == kTriggers; });
  EXPECT_EQ(status.trigger, kTriggers);
  EXPECT_EQ(status.cameras[0].frames, frames);
  EXPECT_EQ(status.cameras[0].missed, kTriggers - frames);
  EXPECT_EQ(status.cameras[0].lost, 0U) << "frames without a trigger are not lost";
}

TEST_F(TriggeredPipeline, AFrameStampedAtItsEndBelongsToTheTriggerThatBeganIt) {
  const auto trigger = trigger_first_camera();
  constexpr std::chrono::milliseconds kPeriod{10}, kExposure{6}, kReadout{8};
  cameras[0]->set_stamps({.readout_time = kReadout});
  start();
  const auto begin = hal::Clock::now();
  trigger->on_edge({hal::Edge::Rising, begin});
  for (std::uint64_t part = 1; part <= 5; ++part) {
    // The next part's edge comes before this one's frame has arrived.
    const auto edge = begin + (part - 1) * kPeriod;
    trigger->on_edge({hal::Edge::Rising, edge + kPeriod});
    cameras[0]->expose(40000, {.exposure_start = edge + kExposure + kReadout,
                               .stamp_source = hal::StampSource::FrameEnd,
                               .exposure_time = kExposure});
    const Status status = sink.wait_for([part](const Status& s) { return s.frame_set == part; });
    EXPECT_EQ(status.trigger, part);
    EXPECT_EQ(status.cameras[0].missed, 0U);
  }
}

TEST_F(TriggeredPipeline, ACameraFaultMissesItsTriggers) {
  const auto trigger = trigger_first_camera();
  start();
  trigger->on_edge({hal::Edge::Rising, hal::Clock::now()});
  cameras[0]->fail_with(hal::Fault::Unplugged);
  const Status status = sink.wait_for([](const Status& s) { return s.cameras[0].missed == 1; });
  EXPECT_EQ(status.cameras[0].triggers, 1U);
  EXPECT_EQ(status.cameras[0].frames, 0U);
}

TEST_F(TriggeredPipeline, TriggersOfAnOutageAreMissedAndGetNoResult) {
  const auto trigger = trigger_first_camera();
  start();
  cameras[0]->fail_with(hal::Fault::Unplugged);
  constexpr std::uint64_t kTriggers = 40;  // more than can wait
  const auto now = hal::Clock::now();
  for (std::uint64_t i = kTriggers; i > 0; --i) {
    trigger->on_edge({hal::Edge::Rising, now - std::chrono::seconds(5 * i)});
  }
  cameras[0]->expose(40000, now);
  Status status = sink.wait_for([](const Status& s) { return s.cameras[0].missed == kTriggers; });
  EXPECT_EQ(status.result, 0U);
  trigger->on_edge({hal::Edge::Rising, hal::Clock::now()});
  cameras[0]->expose(40000);
  status = sink.wait_for([](const Status& s) { return s.frame_set > 0; });
  EXPECT_EQ(status.frame_set, 1U);
  EXPECT_EQ(status.trigger, kTriggers + 1);
  EXPECT_EQ(status.result, 1U);
  EXPECT_EQ(status.cameras[0].frames, 1U);
}

TEST_F(TriggeredPipeline, ATriggerOfAnAbsentCameraIsMissed) {
  const auto trigger = trigger_first_camera();
  plan.absent[0] = true;
  start();
  trigger->on_edge({hal::Edge::Rising, hal::Clock::now()});
  pipeline->miss(0, hal::Fault::Unplugged);
  sink.wait_for([](const Status& s) { return s.cameras[0].missed == 1; });
  trigger->on_edge({hal::Edge::Rising, hal::Clock::now()});
  ASSERT_TRUE(pipeline->admit(0, pipeline->formats()[0]));
  sink.wait_for([](const Status& s) { return s.cameras[0].missed == 2; });
  cameras[0]->expose(40000);  // without a trigger
  trigger->on_edge({hal::Edge::Rising, hal::Clock::now()});
  cameras[0]->expose(40000);
  const Status status = sink.wait_for([](const Status& s) { return s.frame_set == 1; });
  EXPECT_EQ(status.trigger, 3U);
}

TEST_F(TriggeredPipeline, ADamagedFrameMissesItsTriggerAndIsNoFault) {
  const auto trigger = trigger_first_camera();
  start();
  const auto first = hal::Clock::now();
  const auto second = first + std::chrono::milliseconds(1);
  trigger->on_edge({hal::Edge::Rising, first});
  trigger->on_edge({hal::Edge::Rising, second});
  cameras[0]->expose_damaged(first);
  cameras[0]->expose(40000, second);
  const Status status = sink.wait_for([](const Status& s) { return s.frame_set == 1; });
  EXPECT_EQ(status.trigger, 2U) << "still waited for its frame";
  EXPECT_EQ(status.cameras[0].fault, hal::Fault::None);
  EXPECT_EQ(status.cameras[0].damaged, 1U);
  EXPECT_EQ(status.cameras[0].missed, 1U);
  EXPECT_EQ(status.cameras[0].frames, 1U);
}

}  // namespace
}  // namespace orbwatch::app::pipeline
