// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/hal/v4l2/drivers/camera_run.h"
#include "tests/hal/v4l2/drivers/vivid_device.h"

/// Faults of a camera, injected by vivid: each is reported, and the camera recovers by itself.
namespace orbwatch::hal {
namespace {

TEST(VividFaults, DroppedBuffersAreGapsInTheSequence) {
  CameraRun run(vivid_settings());
  ASSERT_TRUE(run.start(kVividRequest));
  ASSERT_TRUE(run.next_frame());
  set_vivid("percentage_of_dropped_buffers", 70);
  std::uint64_t last = run.next_frame()->metadata.sequence;
  bool gap = false;
  for (int n = 0; n < 200 && !gap; ++n) {
    const Frame frame = run.next_frame();
    ASSERT_TRUE(frame);
    gap = frame->metadata.sequence > last + 1;
    last = frame->metadata.sequence;
  }
  set_vivid("percentage_of_dropped_buffers", 0);
  EXPECT_TRUE(gap);
}

TEST(VividFaults, ADamagedFrameIsWithheldAndCounted) {
  CameraRun run(vivid_settings());
  ASSERT_TRUE(run.start(kVividRequest));
  ASSERT_TRUE(run.next_frame());
  for (std::uint64_t n = 1; n < DamageWatch::kTooMany; ++n) {
    set_vivid("inject_v4l2_buf_flag_error", 1);
    while (run.camera().quality().damaged < n) ASSERT_TRUE(run.next_frame());
  }
  EXPECT_TRUE(run.next_frame());
  EXPECT_FALSE(run.has_reported());
}

TEST(VividFaults, ManyDamagedFramesAreAFaultUntilTheyStop) {
  CameraRun run(vivid_settings());
  ASSERT_TRUE(run.start(kVividRequest));
  ASSERT_TRUE(run.next_frame());
  for (std::uint64_t n = 1; n <= DamageWatch::kTooMany; ++n) {
    set_vivid("inject_v4l2_buf_flag_error", 1);
    while (run.camera().quality().damaged < n) std::this_thread::yield();
  }
  EXPECT_TRUE(run.reports(Fault::CorruptFrame));
  EXPECT_TRUE(run.reports(Fault::None));
  EXPECT_TRUE(run.next_frame());
}

TEST(VividFaults, ABrokenStreamIsOpenedAgain) {
  CameraRun run(vivid_settings());
  ASSERT_TRUE(run.start(kVividRequest));
  ASSERT_TRUE(run.next_frame());
  set_vivid("inject_fatal_streaming_error", 1);
  EXPECT_TRUE(run.reports(Fault::ReadError));
  EXPECT_TRUE(run.reports(Fault::None));
  EXPECT_TRUE(run.next_frame());
}

class VividStartError : public testing::TestWithParam<const char*> {};

TEST_P(VividStartError, IsReportedAndTriedAgain) {
  CameraRun run(vivid_settings());
  ASSERT_TRUE(run.camera().configure(kVividRequest));
  set_vivid(GetParam(), 1);
  ASSERT_TRUE(run.start(kVividRequest));
  EXPECT_TRUE(run.reports(Fault::ReadError));
  EXPECT_TRUE(run.reports(Fault::None));
  EXPECT_TRUE(run.next_frame());
}
INSTANTIATE_TEST_SUITE_P(OfDriver, VividStartError,
                         testing::Values("inject_vidioc_reqbufs_error", "inject_vidioc_qbuf_error",
                                         "inject_vidioc_streamon_error"));

/// Open files, and mappings of device memory.
struct Holdings {
  std::ptrdiff_t files = 0;
  int mappings = 0;
  bool operator==(const Holdings&) const = default;
};

Holdings holdings() {
  namespace fs = std::filesystem;
  Holdings held;
  held.files = std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    const bool device =
        line.find("/dev/video") != std::string::npos || line.find("dmabuf") != std::string::npos;
    held.mappings += device ? 1 : 0;
  }
  return held;
}

void PrintTo(const Holdings& held, std::ostream* out) {
  *out << held.files << " files, " << held.mappings << " mappings";
}

/// First pixels of a frame.
std::vector<std::byte> first_row(const Frame& frame) {
  const std::byte* data = frame->picture.planes[0].data;
  return {data, data + frame->picture.planes[0].stride};
}

TEST(VividFaults, UnpluggingIsReportedAndNothingIsLeftBehindByManyReturns) {
  const Holdings before = holdings();
  {
    CameraRun run(vivid_settings());
    ASSERT_TRUE(run.start(kVividRequest));
    ASSERT_TRUE(run.next_frame());
    Holdings streaming;
    for (int n = 0; n < 4; ++n) {
      Frame held = run.next_frame();
      ASSERT_TRUE(held);
      const auto row = first_row(held);
      plug("unbind");
      EXPECT_TRUE(run.reports(Fault::Unplugged));
      EXPECT_EQ(first_row(held), row) << "of a frame that is held while its camera is gone";
      plug("bind");
      EXPECT_TRUE(run.reports(Fault::None));
      EXPECT_EQ(first_row(held), row) << "of a frame that is held while its camera is back";
      held.reset();
      // The frame held now belongs to the new stream.
      ASSERT_TRUE(run.next_frame());
      if (n == 0) streaming = holdings();
      EXPECT_EQ(holdings(), streaming) << "return " << n;
    }
    EXPECT_GT(streaming.mappings, 0);
  }
  EXPECT_EQ(holdings(), before);
}

TEST(VividFaults, ADisconnectedDeviceComesBackWithItsControls) {
  CameraRun run(vivid_settings());
  ASSERT_TRUE(run.start(kVividRequest));
  ASSERT_TRUE(run.next_frame());
  const auto set = run.camera().set("Brightness", 77);
  ASSERT_TRUE(set) << set.error().message;
  set_vivid("disconnect", 1);
  EXPECT_TRUE(run.reports(Fault::Unplugged));
  plug("unbind");
  EXPECT_TRUE(run.camera().set("Contrast", 66)) << "set when it is back";
  plug("bind");
  EXPECT_TRUE(run.reports(Fault::None));
  const V4l2Device device = open_vivid();
  EXPECT_EQ(device.control(find_control(device, "Brightness").value()).value(), 77);
  EXPECT_EQ(device.control(find_control(device, "Contrast").value()).value(), 66);
}

TEST(VividFaults, AConsumerThatHoldsAllFramesIsNoFaultOfTheCamera) {
  CameraRun run(vivid_settings());
  ASSERT_TRUE(run.start(kVividRequest));
  ASSERT_TRUE(run.next_frame());
  std::vector<Frame> held;
  while (held.size() < kFreeRunningBuffers) {
    const Frame frame = run.next_frame();
    ASSERT_TRUE(frame);
    if (std::find(held.begin(), held.end(), frame) == held.end()) held.push_back(frame);
  }
  run.release();
  const std::uint64_t last = held.back()->metadata.sequence;
  held.clear();
  const Frame frame = run.next_frame();
  ASSERT_TRUE(frame);
  EXPECT_GT(frame->metadata.sequence, last);
}

}  // namespace
}  // namespace orbwatch::hal
