// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>

#include "tests/compliance/compliance.h"

/// Frames of the negotiated format, in order, in any number; Witness checks each.
namespace orbwatch::tests {
namespace {

class FrameCount : public Compliance, public testing::WithParamInterface<std::size_t> {};

TEST_P(FrameCount, ThenStop) {
  if (GetParam() > subject.limited(GetParam())) {
    GTEST_SKIP() << "this camera is given " << subject.limited(GetParam()) << " frames a case";
  }
  stream(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Fibonacci, FrameCount, testing::Values(1, 2, 3, 5, 8, 13, 21, 34, 55, 89),
                         testing::PrintToStringParamName());

TEST_F(Compliance, SaysWhoItIs) {
  const hal::CameraInfo& info = camera->info();
  EXPECT_FALSE(info.id.empty());
  EXPECT_FALSE(info.model.empty());
  EXPECT_FALSE(info.back_end.empty());
  EXPECT_EQ(subject.make()->info().id, info.id) << "not stable";
}

TEST_F(Compliance, ASizeIsHonouredOrRefused) {
  using hal::StreamRequest;
  int refused = 0;
  for (const StreamRequest& odd :
       {StreamRequest{1, 1}, StreamRequest{3, 5}, StreamRequest{format.width + 1, format.height},
        StreamRequest{format.width, format.height - 1}, StreamRequest{16384, 16384},
        StreamRequest{1 << 30, 1 << 30}, StreamRequest{-format.width, format.height},
        StreamRequest{0, 0, -1}, StreamRequest{0, 0, std::nan("")}}) {
    const auto agreed = camera->configure(odd);
    if (agreed) {
      EXPECT_TRUE(odd.width == 0 || agreed->width == odd.width) << agreed->width;
      EXPECT_TRUE(odd.height == 0 || agreed->height == odd.height) << agreed->height;
      EXPECT_GE(odd.frame_rate, 0) << "took a rate that is none";
      continue;
    }
    ++refused;
    EXPECT_FALSE(agreed.error().message.empty());
    Witness witness(format);
    EXPECT_FALSE(camera->start([](const hal::Frame&) {}, [](const hal::FaultReport&) {}))
        << "starts although its configuration was refused";
  }
  EXPECT_GE(refused, 4) << "sizes that nobody has and rates that are none";
  ASSERT_NO_FATAL_FAILURE(configure(*camera, subject.request(), format));
  stream(3);
}

TEST_F(Compliance, AnUnknownControlIsRefusedByName) {
  for (const bool running : {false, true}) {
    Witness witness(format);
    if (running) {
      ASSERT_NO_FATAL_FAILURE(witness.start(*camera));
      witness.wait_for_frames(1);
    }
    const auto set = camera->set("NoSuchControl", 1);
    ASSERT_FALSE(set);
    EXPECT_NE(set.error().message.find("NoSuchControl"), std::string::npos) << set.error().message;
    if (!running) continue;
    witness.wait_for_frames(3);
    witness.stop(*camera);
  }
}

}  // namespace
}  // namespace orbwatch::tests
