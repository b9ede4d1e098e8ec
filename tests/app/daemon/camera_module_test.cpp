// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/app/daemon/daemon_program.h"

/// Behaviour of the programs without the module of a camera's back-end.
namespace orbwatch::tests {
namespace {

using testing::HasSubstr;

const std::string kRig = R"(
[[camera]]
name = "far"
width = 64
height = 48
[camera.outline]
centre = [32, 24]
radius = 20
alpha = 340
)";

const std::string kSite = R"(
[[camera]]
name = "far"
back_end = "libcamera"
width = 64
height = 48
[camera.libcamera]
camera = "imx477"
[[view]]
name = "front"
width = 32
height = 24
[[view.source]]
camera = "far"
)";

class WithoutModules : public Daemon {
 protected:
  WithoutModules() { setenv("ORBWATCH_MODULES", folder.path().c_str(), 1); }
  ~WithoutModules() override { unsetenv("ORBWATCH_MODULES"); }

  std::string write_site() const {
    std::ofstream(folder / "rig.toml") << kMachine << kRig;
    const auto path = folder / "site.toml";
    std::ofstream(path) << "rig = \"rig.toml\"\n[modbus]\naddress = \"127.0.0.1\"\nport = " << port
                        << "\n[dds]\nenabled = false\n"
                        << kSite;
    return path.string();
  }
};

TEST_F(WithoutModules, ACameraIsAbsentAndTheLogSaysWhatToInstall) {
  Subprocess daemon = start(write_site());
  EXPECT_TRUE(says(daemon,
                   "camera far: the camera needs the module libcamera, which is not "
                   "installed: sudo apt install ./orbwatch-camera-libcamera_*.deb"))
      << daemon.output();
  ASSERT_TRUE(eventually(daemon, [&] { return read("system_heartbeat") > 0; })) << daemon.output();
  EXPECT_EQ(read("camera_0_fault"), 1) << "not connected, or cannot be opened";
}

TEST_F(WithoutModules, TheFilesCanBeChecked) {
  Subprocess check({ORBWATCHD_PROGRAM, "--config", write_site(), "--check"}, folder / "check.log");
  EXPECT_EQ(check.wait(), 0) << check.output();
}

TEST_F(WithoutModules, TheProgramsNameTheModuleAndDoNotNeedItsLibrary) {
  for (const char* program : {ORBWATCH_PROGRAM, ORBWATCHD_PROGRAM}) {
    Subprocess version({program, "--version"}, folder / "version.log");
    EXPECT_EQ(version.wait(), 0);
    EXPECT_THAT(version.output(), HasSubstr("\nlibcamera not installed\n"));
    std::ifstream file(program, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(file), {});
    EXPECT_THAT(bytes.size(), testing::Gt(100000U));
    EXPECT_EQ(bytes.find("libcamera.so."), std::string::npos) << program;
  }
}

/// The loader's work is most of a command's time, and its pages are resident in the daemon.
TEST_F(WithoutModules, TheProgramsLoadFewLibrariesAndNoneForPictureFilesOrVideos) {
  constexpr int kMost = 90;
  for (const char* program : {ORBWATCH_PROGRAM, ORBWATCHD_PROGRAM}) {
    Subprocess list({"/usr/bin/ldd", program}, folder / "libraries.log");
    ASSERT_EQ(list.wait(), 0) << list.output();
    const std::string libraries = list.output();
    EXPECT_THAT(libraries, HasSubstr("libopencv_core.so"));
    for (const char* unused :
         {"libopencv_videoio", "libopencv_imgcodecs", "libgdal", "libavcodec"}) {
      EXPECT_THAT(libraries, testing::Not(HasSubstr(unused))) << program;
    }
    EXPECT_LE(std::ranges::count(libraries, '\n'), kMost) << program << "\n" << libraries;
  }
}

}  // namespace
}  // namespace orbwatch::tests
