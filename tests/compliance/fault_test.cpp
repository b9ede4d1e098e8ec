// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include "tests/compliance/compliance.h"
#include "tests/compliance/kept_frame.h"

/// Cameras that are unplugged and replugged, beside others that stream.
namespace orbwatch::tests {
namespace {

bool is_fault(hal::Fault fault) { return fault != hal::Fault::None; }
bool is_well(hal::Fault fault) { return fault == hal::Fault::None; }

/// Checks a camera that is unplugged and replugged.
void expect_return(hal::Camera& camera, Witness& witness, const CameraUnderTest& subject) {
  ASSERT_NO_FATAL_FAILURE(witness.start(camera));
  witness.wait_for_frames(3);
  subject.unplug();
  ASSERT_NO_FATAL_FAILURE(witness.wait_for_fault(0, is_fault));
  const std::size_t reports = witness.faults().size();
  subject.replug();
  ASSERT_NO_FATAL_FAILURE(witness.wait_for_fault(reports - 1, is_well));
  witness.wait_for_frames(witness.frames().size() + subject.limited(5));
}

TEST_F(Compliance, ComesBackAfterItWasUnplugged) {
  if (!subject.can_be_unplugged()) GTEST_SKIP() << "the settings do not say how to unplug it";
  camera.reset();
  camera = subject.make_unpluggable();
  ASSERT_NO_FATAL_FAILURE(configure(*camera, subject.request(), format));
  Witness witness(format);
  ASSERT_NO_FATAL_FAILURE(expect_return(*camera, witness, subject));
  witness.stop(*camera);
  EXPECT_EQ(witness.faults().back().fault, hal::Fault::None);
}

TEST_F(Compliance, StopsWhileItIsUnpluggedAndItsFramesStayValid) {
  if (!subject.can_be_unplugged()) GTEST_SKIP() << "the settings do not say how to unplug it";
  camera.reset();
  camera = subject.make_unpluggable();
  ASSERT_NO_FATAL_FAILURE(configure(*camera, subject.request(), format));
  std::optional<KeptFrame> kept;
  {
    Witness witness(format, [&](const hal::Frame& frame) {
      if (!kept) kept.emplace(frame);
    });
    ASSERT_NO_FATAL_FAILURE(witness.start(*camera));
    witness.wait_for_frames(3);
    subject.unplug();
    ASSERT_NO_FATAL_FAILURE(witness.wait_for_fault(0, is_fault));
    witness.stop(*camera);
  }
  camera.reset();
  ASSERT_TRUE(kept);
  EXPECT_TRUE(kept->is_unchanged());
  subject.replug();
}

/// Fixture with the camera, and another one that must stream undisturbed.
class TwoCameras : public Compliance {
 protected:
  void SetUp() override {
    if (!subject.has_another()) GTEST_SKIP() << "the settings name one camera only";
    Compliance::SetUp();
    other = subject.make_another();
    ASSERT_NO_FATAL_FAILURE(configure(*other, subject.another_request(), other_format));
  }

  std::unique_ptr<hal::Camera> other;
  hal::StreamFormat other_format;
};

TEST_F(TwoCameras, StreamTogether) {
  Witness witness(format), other_witness(other_format);
  ASSERT_NO_FATAL_FAILURE(witness.start(*camera));
  ASSERT_NO_FATAL_FAILURE(other_witness.start(*other));
  witness.wait_for_frames(subject.limited(34));
  other_witness.wait_for_frames(subject.limited(34));
  witness.stop(*camera);
  other_witness.stop(*other);
  EXPECT_TRUE(witness.faults().empty());
  EXPECT_TRUE(other_witness.faults().empty());
}

TEST_F(TwoCameras, OneRestartsAndIsDestroyedWhileTheOtherGoesOn) {
  Witness other_witness(other_format);
  ASSERT_NO_FATAL_FAILURE(other_witness.start(*other));
  for (int round = 0; round < 3; ++round) {
    ASSERT_NO_FATAL_FAILURE(stream(3));
    other_witness.wait_for_frames(other_witness.frames().size() + 1);
  }
  camera.reset();
  other_witness.wait_for_frames(other_witness.frames().size() + subject.limited(3));
  other_witness.stop(*other);
  EXPECT_TRUE(other_witness.faults().empty());
}

TEST_F(TwoCameras, OneIsUnpluggedWhileTheOtherGoesOn) {
  if (!subject.can_be_unplugged()) GTEST_SKIP() << "the settings do not say how to unplug it";
  camera.reset();
  camera = subject.make_unpluggable();
  ASSERT_NO_FATAL_FAILURE(configure(*camera, subject.request(), format));
  Witness witness(format), other_witness(other_format);
  ASSERT_NO_FATAL_FAILURE(other_witness.start(*other));
  other_witness.wait_for_frames(1);
  ASSERT_NO_FATAL_FAILURE(expect_return(*camera, witness, subject));
  witness.stop(*camera);
  other_witness.wait_for_frames(other_witness.frames().size() + subject.limited(3));
  other_witness.stop(*other);
  EXPECT_TRUE(other_witness.faults().empty());
}

}  // namespace
}  // namespace orbwatch::tests
