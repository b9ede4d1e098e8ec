// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/device/v4l2_device.h"

#include <fcntl.h>
#include <gtest/gtest.h>

namespace orbwatch::hal {
namespace {

TEST(V4l2Device, AMissingOneIsUnplugged) {
  const auto device = V4l2Device::open("/dev/no-such-camera");
  ASSERT_FALSE(device);
  EXPECT_EQ(device.error().fault, Fault::Unplugged);
  EXPECT_NE(device.error().detail.find("/dev/no-such-camera"), std::string::npos);
}

TEST(V4l2Device, AnotherKindOfDeviceIsRefused) {
  for (const char* path : {"/dev/null", "/dev/zero"}) {
    const auto device = V4l2Device::open(path);
    ASSERT_FALSE(device) << path;
    EXPECT_EQ(device.error().fault, Fault::WrongFormat) << path;
  }
  const auto folder = V4l2Device::open("/dev");
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().fault, Fault::ReadError);
}

bool is_open(int descriptor) { return ::fcntl(descriptor, F_GETFD) != -1; }

TEST(FileDescriptor, ClosesWhatItOwnsOnce) {
  int number = -1;
  {
    FileDescriptor first(::open("/dev/null", O_RDONLY | O_CLOEXEC));
    number = first.get();
    ASSERT_TRUE(is_open(number));
    FileDescriptor second(std::move(first));
    EXPECT_FALSE(first.is_open());  // a moved-from descriptor is closed
    EXPECT_EQ(second.get(), number);
    EXPECT_TRUE(is_open(number));
  }
  EXPECT_FALSE(is_open(number));
}

}  // namespace
}  // namespace orbwatch::hal
