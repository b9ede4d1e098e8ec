// SPDX-License-Identifier: Apache-2.0
#include "hal/module/module_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "hal/libcamera/libcamera_settings.h"
#include "hal/module/load_module.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::hal {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

/// Folder of modules that ORBWATCH_MODULES names during the fixture's lifetime.
class ModuleCamera : public testing::Test {
 protected:
  ModuleCamera() { ::setenv("ORBWATCH_MODULES", folder_.path().c_str(), 1); }
  ~ModuleCamera() override { ::unsetenv("ORBWATCH_MODULES"); }

  void install(const std::string& name) {
    std::filesystem::copy_file(std::filesystem::path(ORBWATCH_TEST_MODULES) / (name + ".so"),
                               module_file("libcamera"));
  }

  static std::string refusal() {
    LibcameraSettings settings;
    settings.camera = "imx477";
    const auto camera = make_camera(settings, CameraContext{});
    const auto format = camera->configure({});
    return format ? "was configured" : format.error().message;
  }

  tests::TemporaryFolder folder_;
};

TEST_F(ModuleCamera, IsAbsentWithoutTheModuleAndSaysWhatToInstall) {
  EXPECT_THAT(refusal(),
              AllOf(HasSubstr("the camera needs the module libcamera, which is not "
                              "installed: sudo apt install ./orbwatch-camera-libcamera_*.deb (of "
                              "a bundle: sudo ./install orbwatch-camera-libcamera)"),
                    HasSubstr(folder_.path().string())));
  EXPECT_THAT(list_module_cameras(), IsEmpty());
  EXPECT_THAT(module_versions(), testing::ElementsAre(Pair("libcamera", "not installed"),
                                                      Pair("genicam", "not installed"),
                                                      Pair("video", "not installed")));
}

TEST_F(ModuleCamera, IsTheModules) {
  install("fitting_module");
  EXPECT_EQ(refusal(), "was configured");
  EXPECT_EQ(list_module_cameras().size(), 1U);
  EXPECT_THAT(module_versions(),
              testing::ElementsAre(Pair("libcamera", "1.0"), Pair("genicam", "not installed"),
                                   Pair("video", "not installed")));
}

TEST_F(ModuleCamera, VersionsDoNotLoadTheModuleOfVideos) {
  std::ofstream(module_file("video")) << "not loadable";
  EXPECT_THAT(module_versions(), testing::Contains(Pair("video", "installed")));
}

TEST_F(ModuleCamera, IsAbsentWithAModuleThatDoesNotFit) {
  install("older_module");
  EXPECT_THAT(refusal(), HasSubstr("has module interface 0"));
  const auto cameras = list_module_cameras();
  ASSERT_EQ(cameras.size(), 1U);
  EXPECT_THAT(cameras[0].problem, HasSubstr("has module interface 0"));
  EXPECT_THAT(
      module_versions(),
      testing::ElementsAre(Pair("libcamera", HasSubstr("has module interface 0")),
                           Pair("genicam", "not installed"), Pair("video", "not installed")));
}

}  // namespace
}  // namespace orbwatch::hal
