// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <utility>

#include "hal/genicam/genicam_camera.h"
#include "hal/lines/frame_trigger.h"
#include "tests/hal/genicam/fake_gige_camera.h"
#include "tests/hal/genicam/resending_proxy.h"

/// Tests of triggers on Aravis' fake camera, in networks of their own.
namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;
using tests::FakeGigeCamera;
using tests::Receiver;

/// Assigns triggers as the pipeline does.
Camera::Gate assigns(FrameTrigger& trigger) {
  return [&trigger](FrameMetadata& metadata) {
    if (metadata.status == FrameStatus::Withheld) return trigger.miss(metadata.exposure_start);
    const auto stamp = trigger.claim(metadata.exposure_start);
    if (stamp) metadata.trigger = stamp->id;
    return stamp.has_value();
  };
}

std::uint64_t trigger_after_sequence(const FrameMetadata& metadata) {
  return metadata.trigger.value() - metadata.sequence;
}

TEST(TriggeredGenicamCamera, ALostFirstPacketCostsItsFrameAndItsTriggerOnly) {
  ORBWATCH_REQUIRE_NETWORK_NAMESPACES();
  constexpr auto kPeriod = 200ms;
  constexpr int kLoss = 8;  // fewer lost frames than are a fault
  FrameTrigger trigger({.mode = TriggerMode::Line}, {});
  int sent = 0;
  const tests::NetworkNamespace ours, theirs;
  const tests::Cable cable(ours, theirs);
  std::optional<FakeGigeCamera> fake;
  std::optional<tests::ResendingProxy> proxy;
  theirs.run([&] {
    fake.emplace(FakeGigeCamera::Options{});
    // The fake camera stamps with the system's time; an edge is half a period before its frame.
    proxy.emplace(tests::Cable::kRight, 0, [&](std::uint64_t stamp) {
      trigger.fire(arrival_of(stamp, Clock::now()) - kPeriod / 2);
      return ++sent % kLoss == 0;
    });
  });
  ours.run([&] {
    GenicamCamera camera(GenicamSettings::at(tests::Cable::kRight));
    const auto format = camera.configure({64, 48, 1s / kPeriod});
    ASSERT_TRUE(format) << format.error().message;
    ASSERT_TRUE(camera.set("ExposureTime", 1000));
    camera.set_gate(assigns(trigger));
    Receiver<FrameMetadata> receiver([](const FrameBuffer& frame) { return frame.metadata; });
    receiver.start(camera);
    const auto frames = receiver.wait_for(20);
    camera.stop();
    for (const FrameMetadata& frame : frames) {
      EXPECT_EQ(trigger_after_sequence(frame), trigger_after_sequence(frames.front()))
          << "frame " << frame.sequence;
    }
    EXPECT_EQ(trigger.counts().untriggered, 0U);
    EXPECT_GE(camera.quality().damaged, 2U);
  });
}

/// Executes `work` in a network with the fake camera.
void with_fake_camera(const FakeGigeCamera::Options& options,
                      const std::function<void(FakeGigeCamera&)>& work) {
  const tests::NetworkNamespace network;
  network.run([&] {
    FakeGigeCamera fake(options);
    work(fake);
  });
}

TEST(TriggeredGenicamCamera, ReportsALossOfControlBeforeItIsClosed) {
  ORBWATCH_REQUIRE_NETWORK_NAMESPACES();
  with_fake_camera({}, [](FakeGigeCamera& fake) {
    std::promise<std::string> refusal;  // of a trigger while the fault is reported
    bool is_reported = false;
    GenicamCamera camera(GenicamSettings::at(FakeGigeCamera::kAddress));
    ASSERT_TRUE(camera.configure({64, 48, 100}));
    ASSERT_TRUE(camera.set("TriggerMode", 1));
    ASSERT_TRUE(camera.start([](const Frame&) {},
                             [&](const FaultReport&) {
                               if (std::exchange(is_reported, true)) return;
                               const auto done = camera.trigger();
                               refusal.set_value(done ? "" : done.error().message);
                             }));
    ASSERT_TRUE(tests::comes_true([&] { return camera.trigger().has_value(); }));
    // A camera that restarts has no controller.
    fake.kill();
    fake.start();
    auto reported = refusal.get_future();
    ASSERT_EQ(reported.wait_for(1min), std::future_status::ready);
    EXPECT_THAT(reported.get(), Not(HasSubstr("does not run")));
  });
}

TEST(TriggeredGenicamCamera, RunsFreelyAgainWithoutTheControlAlsoAtAFixedRate) {
  ORBWATCH_REQUIRE_NETWORK_NAMESPACES();
  with_fake_camera({.lacks = {"AcquisitionFrameRate"}}, [](FakeGigeCamera&) {
    {
      GenicamCamera earlier(GenicamSettings::at(FakeGigeCamera::kAddress));
      ASSERT_TRUE(earlier.configure({64, 48}));
      ASSERT_TRUE(earlier.set("TriggerMode", 1));
    }
    GenicamCamera camera(GenicamSettings::at(FakeGigeCamera::kAddress));
    ASSERT_TRUE(camera.configure({64, 48}));
    Receiver<std::uint64_t> receiver(
        [](const FrameBuffer& frame) { return frame.metadata.sequence; });
    receiver.start(camera);
    EXPECT_FALSE(receiver.wait_for(1).empty());
  });
}

TEST(TriggeredGenicamCamera, NeedsNoTriggersToRunAtAFixedRate) {
  ORBWATCH_REQUIRE_NETWORK_NAMESPACES();
  with_fake_camera({.lacks = {"AcquisitionFrameRate", "TriggerMode"}}, [](FakeGigeCamera&) {
    GenicamCamera camera(GenicamSettings::at(FakeGigeCamera::kAddress));
    const auto format = camera.configure({64, 48});
    EXPECT_TRUE(format) << format.error().message;
  });
}

}  // namespace
}  // namespace orbwatch::hal
