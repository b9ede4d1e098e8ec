// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/device/v4l2_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace orbwatch::hal {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class DeviceFolder : public testing::Test {
 protected:
  /// Makes a file that has the name of a device node but is not one.
  fs::path make_node(const std::string& name) {
    std::ofstream(folder_.path() / name) << "not a device";
    return folder_.path() / name;
  }
  void make_link(const char* links, const char* name, const fs::path& target) {
    fs::create_directories(folder_.path() / "v4l" / links);
    fs::create_symlink(target, folder_.path() / "v4l" / links / name);
  }

  tests::TemporaryFolder folder_;
};

TEST_F(DeviceFolder, IsSearchedForLinksByTheirName) {
  const auto node = make_node("video3");
  make_link("by-id", "usb-Maker_Camera_0001-video-index0", node);
  make_link("by-path", "pci-0000:00:14.0-usb-0:1:1.0-video-index0", node);
  EXPECT_EQ(find_v4l2_device("usb-Maker_Camera_0001-video-index0", folder_.path()).value(),
            (folder_.path() / "v4l/by-id/usb-Maker_Camera_0001-video-index0").string());
  EXPECT_EQ(find_v4l2_device("pci-0000:00:14.0-usb-0:1:1.0-video-index0", folder_.path()).value(),
            (folder_.path() / "v4l/by-path/pci-0000:00:14.0-usb-0:1:1.0-video-index0").string());
}

TEST_F(DeviceFolder, TakesAPathAsItIs) {
  EXPECT_EQ(find_v4l2_device("/dev/no-such-camera", folder_.path()).value(), "/dev/no-such-camera");
}

TEST_F(DeviceFolder, SaysThatACameraIsNotThere) {
  make_node("video0");
  make_link("by-id", "gone", folder_.path() / "video7");
  for (const char* name : {"usb-0000:00:14.0-1", "gone", ""}) {
    const auto found = find_v4l2_device(name, folder_.path());
    ASSERT_FALSE(found) << name;
    EXPECT_EQ(found.error().fault, Fault::Unplugged);
    EXPECT_THAT(found.error().detail, HasSubstr("\"" + std::string(name) + "\""));
  }
}

TEST_F(DeviceFolder, ListsOnlyNodesThatMayBeCamerasInTheirOrder) {
  // Regular files and devices of another kind are not cameras; a broken link is a missing camera,
  // which is worth a line.
  make_node("video0");
  make_node("video");
  make_node("videos");
  make_node("vbi0");
  for (const char* name : {"video10", "video2"}) {
    fs::create_symlink(folder_.path() / "nothing", folder_.path() / name);
  }
  const auto cameras = list_v4l2_cameras(folder_.path());
  ASSERT_EQ(cameras.size(), 2U);
  EXPECT_EQ(cameras[0].id, (folder_.path() / "video2").string());
  EXPECT_THAT(cameras[0].problem, HasSubstr("No such file"));
  EXPECT_EQ(cameras[1].id, (folder_.path() / "video10").string());
}

TEST_F(DeviceFolder, MayBeMissing) {
  EXPECT_TRUE(list_v4l2_cameras(folder_.path() / "nowhere").empty());
}

}  // namespace
}  // namespace orbwatch::hal
