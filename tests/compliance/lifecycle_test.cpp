// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <future>

#include "tests/compliance/compliance.h"

/// Calls of configure, start and stop in every order.
namespace orbwatch::tests {
namespace {

void ignore_frame(const hal::Frame&) {}
void ignore_fault(const hal::FaultReport&) {}

TEST_F(Compliance, RefusesToStartUnconfigured) {
  const auto fresh = subject.make();
  EXPECT_FALSE(fresh->start(ignore_frame, ignore_fault));
  fresh->stop();
  EXPECT_FALSE(fresh->start(ignore_frame, ignore_fault));
}

TEST_F(Compliance, Restarts) {
  for (int round = 0; round < 3; ++round) ASSERT_NO_FATAL_FAILURE(stream(5));
}

TEST_F(Compliance, IsConfiguredAgainBetweenStreams) {
  for (int round = 0; round < 3; ++round) {
    const hal::StreamFormat before = format;
    ASSERT_NO_FATAL_FAILURE(configure(*camera, subject.request(), format));
    EXPECT_EQ(format.format, before.format);
    EXPECT_EQ(format.width, before.width);
    EXPECT_EQ(format.height, before.height);
    EXPECT_EQ(format.frame_rate, before.frame_rate);
    ASSERT_NO_FATAL_FAILURE(stream(2));
  }
}

TEST_F(Compliance, RefusesStartAndConfigureWhileItRuns) {
  Witness witness(format);
  ASSERT_NO_FATAL_FAILURE(witness.start(*camera));
  witness.wait_for_frames(1);
  EXPECT_FALSE(camera->start(ignore_frame, ignore_fault));
  EXPECT_FALSE(camera->configure(subject.request()));
  witness.wait_for_frames(4);
  witness.stop(*camera);
  EXPECT_TRUE(witness.faults().empty());
}

TEST_F(Compliance, StopsTwiceAndBeforeItStarted) {
  camera->stop();
  camera->stop();
  Witness witness(format);
  ASSERT_NO_FATAL_FAILURE(witness.start(*camera));
  witness.wait_for_frames(2);
  witness.stop(*camera);
  camera->stop();
  ASSERT_NO_FATAL_FAILURE(stream(2));
}

TEST_F(Compliance, StopsAtOnce) {
  for (int round = 0; round < 5; ++round) {
    Witness witness(format);
    ASSERT_NO_FATAL_FAILURE(witness.start(*camera));
    witness.stop(*camera);
  }
  ASSERT_NO_FATAL_FAILURE(stream(2));
}

TEST_F(Compliance, StopsInsideItsCallbackWhichIsTheLast) {
  const std::size_t last = subject.limited(5);
  for (int round = 0; round < 2; ++round) {
    std::atomic<std::size_t> seen{0};
    std::promise<void> stopped;
    Witness witness(format, [&](const hal::Frame&) {
      if (++seen != last) return;
      camera->stop();
      camera->stop();
      stopped.set_value();
    });
    ASSERT_NO_FATAL_FAILURE(witness.start(*camera));
    witness.wait_for_frames(last);
    stopped.get_future().wait();
    witness.stop(*camera);
    EXPECT_EQ(seen, last);
  }
  ASSERT_NO_FATAL_FAILURE(stream(2));
}

TEST_F(Compliance, RestartsAfterAStopInsideItsCallback) {
  const std::size_t last = 2;
  std::promise<void> stopped;
  Witness witness(format, [&, seen = std::size_t{0}](const hal::Frame&) mutable {
    if (++seen != last) return;
    camera->stop();
    stopped.set_value();
  });
  ASSERT_NO_FATAL_FAILURE(witness.start(*camera));
  stopped.get_future().wait();
  ASSERT_NO_FATAL_FAILURE(stream(3));  // start() joins the stopped thread
}

TEST_F(Compliance, IsDestroyedWhileItRuns) {
  Witness witness(format);
  ASSERT_NO_FATAL_FAILURE(witness.start(*camera));
  witness.wait_for_frames(3);
  camera.reset();
  witness.close();
  camera = subject.make();
  ASSERT_NO_FATAL_FAILURE(configure(*camera, subject.request(), format));
  ASSERT_NO_FATAL_FAILURE(stream(2));
}

TEST_F(Compliance, IsDestroyedAfterAStopInsideItsCallback) {
  std::promise<void> stopped;
  Witness witness(format, [&, first = true](const hal::Frame&) mutable {
    camera->stop();
    if (std::exchange(first, false)) stopped.set_value();
  });
  ASSERT_NO_FATAL_FAILURE(witness.start(*camera));
  stopped.get_future().wait();
  camera.reset();
  witness.close();
  EXPECT_EQ(witness.frames().size(), 1U);
}

}  // namespace
}  // namespace orbwatch::tests
