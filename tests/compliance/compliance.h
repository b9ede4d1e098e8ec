// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "tests/compliance/camera_under_test.h"
#include "tests/compliance/witness.h"

namespace orbwatch::tests {

/// Fixture with a configured camera for each case.
class Compliance : public testing::Test {
 protected:
  void SetUp() override { ASSERT_NO_FATAL_FAILURE(configure(*camera, subject.request(), format)); }

  /// Starts the camera, receives `count` frames and stops it.
  void stream(std::size_t count) {
    Witness witness(format);
    ASSERT_NO_FATAL_FAILURE(witness.start(*camera));
    witness.wait_for_frames(subject.limited(count));
    witness.stop(*camera);
  }

  const CameraUnderTest& subject = CameraUnderTest::get();
  std::unique_ptr<hal::Camera> camera = subject.make();
  hal::StreamFormat format;
};

}  // namespace orbwatch::tests
