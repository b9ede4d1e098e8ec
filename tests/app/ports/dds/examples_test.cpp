// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <future>
#include <mutex>
#include <string>
#include <thread>

#include "app/ports/dds/dds_sink.h"
#include "tests/app/hand_over.h"
#include "tests/app/ports/dds/test_views.h"
#include "tests/support/loopback_dds.h"
#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::dds {
namespace {

const std::string kExamples = ORBWATCH_SOURCE_DIR "/app/ports/dds/examples";

/// Output of a shell command, and whether it succeeded.
std::pair<std::string, bool> run(const std::string& command) {
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  std::string output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
  return {output, ::pclose(pipe) == 0};
}

TEST(Examples, ImageSubscriberBuildsByItselfAndReadsAView) {
  const orbwatch::tests::TemporaryFolder folder;
  const std::string build = (folder.path() / "build").string();
  const auto [made, built] =
      run("cmake -S " + kExamples + " -B " + build + " && cmake --build " + build);
  ASSERT_TRUE(built) << made;

  const int domain = 1 + ::getpid() % 100;
  ::setenv("CYCLONEDDS_URI", orbwatch::tests::loopback_dds().c_str(), 1);
  ::setenv("ROS_DOMAIN_ID", std::to_string(domain).c_str(), 1);
  DdsSink sink({.domain = domain}, {{}, {"front"}, {}}, nullptr);
  ASSERT_TRUE(sink.start());
  std::atomic<bool> done{false};
  std::thread camera([&] {
    const auto view = tests::make_view(0, "front", 1, 160, 90);
    while (!done) {
      tests::hand_over(sink, view);
      sink.accept(Status{});
      std::this_thread::sleep_for(std::chrono::milliseconds(5));  // a camera's pace
    }
  });
  const auto [printed, read] =
      run("timeout 60 " + build + "/image_subscriber rt/orbwatch/front/image_raw 3");
  done = true;
  camera.join();
  EXPECT_TRUE(read) << printed;
  EXPECT_THAT(printed, testing::ContainsRegex("front 160x90 rgb8, exposed at [0-9]+"));
}

TEST(Examples, MachinePublisherSendsStatesThatAreTaken) {
  const orbwatch::tests::TemporaryFolder folder;
  const std::string build = (folder.path() / "build").string();
  const auto [made, built] = run("cmake -S " + kExamples + " -B " + build + " && cmake --build " +
                                 build + " --target machine_publisher");
  ASSERT_TRUE(built) << made;

  const int domain = 1 + ::getpid() % 100;
  ::setenv("CYCLONEDDS_URI", orbwatch::tests::loopback_dds().c_str(), 1);
  ::setenv("ROS_DOMAIN_ID", std::to_string(domain).c_str(), 1);
  std::promise<MachineState> newest;
  std::once_flag first;
  const MachinePath machine{MachineSource::Dds, [&](const MachineState& state) {
                              std::call_once(first, [&] { newest.set_value(state); });
                              return check(state);
                            }};
  DdsSink sink({.domain = domain}, {{}, {"front"}, {}}, nullptr, network_addresses,
               std::make_shared<CommandRecord>(), hal::SharedThreads::alone(), {}, nullptr, {}, {},
               machine);
  ASSERT_TRUE(sink.start());
  orbwatch::tests::Subprocess publisher({build + "/machine_publisher"},
                                        folder.path() / "publisher.log");
  auto taken = newest.get_future();
  ASSERT_EQ(taken.wait_for(std::chrono::minutes(1)), std::future_status::ready)
      << publisher.output();
  const MachineState state = taken.get();
  EXPECT_EQ(state.part.text(), "example");
  EXPECT_NEAR(std::hypot(state.values.x, state.values.y), 40, 1e-9);
}

TEST(Examples, PythonCanReadTheRosNodes) {
  for (const std::string example : {"view_subscriber.py", "state_subscriber.py"}) {
    const auto [printed, read] = run("/usr/bin/python3 -c \"import ast; ast.parse(open('" +
                                     kExamples + "/" + example + "').read())\"");
    EXPECT_TRUE(read) << printed;
  }
}

}  // namespace
}  // namespace orbwatch::app::dds
