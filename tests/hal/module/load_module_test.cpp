// SPDX-License-Identifier: Apache-2.0
#include "hal/module/load_module.h"

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <sstream>

#include "hal/thread/scheduling.h"

namespace orbwatch::hal {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::filesystem::path test_module(const std::string& name) {
  return std::filesystem::path(ORBWATCH_TEST_MODULES) / (name + ".so");
}

bool is_loaded(const std::string& name) {
  void* const library = ::dlopen(test_module(name).c_str(), RTLD_LAZY | RTLD_NOLOAD);
  if (library != nullptr) ::dlclose(library);
  return library != nullptr;
}

std::string refusal(const std::string& name, std::string_view back_end = "libcamera") {
  const auto module = load_module(test_module(name), back_end);
  return module ? "was loaded" : module.error().message;
}

TEST(LoadModule, FitsWhenItsHeadersAreThePrograms) {
  const auto module = load_module(test_module("fitting_module"), "libcamera");
  ASSERT_TRUE(module) << module.error().message;
  EXPECT_EQ((*module)->library_version(), "1.0");
  EXPECT_EQ(*load_module(test_module("fitting_module"), "libcamera"), *module);
}

TEST(LoadModule, ACameraOfItDeliversFrames) {
  const auto module = load_module(test_module("fitting_module"), "libcamera");
  ASSERT_TRUE(module) << module.error().message;
  CameraContext context;
  context.name = "far";
  const auto camera = (*module)->make_camera(nullptr, context);
  EXPECT_EQ(camera->info().id, "far");
  ASSERT_TRUE(camera->configure({}));
  std::promise<std::uint64_t> sequence;
  ASSERT_TRUE(
      camera->start([&](const Frame& frame) { sequence.set_value(frame->metadata.sequence); },
                    [](const FaultReport&) {}));
  EXPECT_EQ(sequence.get_future().get(), 7U);
  camera->stop();
}

TEST(LoadModule, UsesThisProgramsHal) {
  const auto module = load_module(test_module("fitting_module"), "libcamera");
  ASSERT_TRUE(module) << module.error().message;
  std::ostringstream address;
  address << reinterpret_cast<const void*>(&schedule_this_thread);
  EXPECT_EQ((*module)->list_cameras().at(0).id, address.str())
      << "threads are scheduled as the program was told, not as a copy of hal was";
}

TEST(LoadModule, RefusesWhatDoesNotFitAndSaysWhatWould) {
  EXPECT_THAT(refusal("older_module"),
              AllOf(HasSubstr("older_module.so: has module interface 0, this program 2"),
                    HasSubstr("install orbwatch-camera-libcamera of this program's version")));
  EXPECT_THAT(refusal("foreign_module"), HasSubstr("was built from other headers"));
  EXPECT_THAT(refusal("fitting_module", "genicam"),
              HasSubstr("is the module of libcamera; install orbwatch-camera-genicam"));
  EXPECT_THAT(refusal("no_module"), HasSubstr("no_module.so: is not a camera module of orbwatch"));
  EXPECT_THAT(refusal("unresolved_module"),
              AllOf(HasSubstr("orbwatch_function_of_a_library_that_is_missing"),
                    HasSubstr("platform/build-deb --module libcamera")));
}

TEST(LoadModule, UnloadsWhatItRefusesAndKeepsWhatFits) {
  for (const char* name : {"older_module", "foreign_module", "no_module"}) {
    EXPECT_NE(refusal(name), "was loaded");
    EXPECT_FALSE(is_loaded(name)) << name;
  }
  ASSERT_EQ(refusal("fitting_module"), "was loaded");
  EXPECT_NE(refusal("fitting_module", "genicam"), "was loaded");
  EXPECT_TRUE(is_loaded("fitting_module")) << "refused as another back-end's only";
}

}  // namespace
}  // namespace orbwatch::hal
