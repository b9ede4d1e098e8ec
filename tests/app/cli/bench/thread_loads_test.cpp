// SPDX-License-Identifier: Apache-2.0
#include "app/cli/bench/thread_loads.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "hal/thread/thread.h"
#include "proc/signals/signals.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::cli {
namespace {

TEST(ThreadLoads, AreReadAsTheKernelWritesThem) {
  const tests::TemporaryFolder folder;
  const auto task = folder.path() / "self/task/712";
  std::filesystem::create_directories(task);
  std::ofstream(task / "comm") << "odd) (name\n";
  std::ofstream(task / "stat")
      << "712 (odd) (name) S 1 712 712 0 -1 4194560 9 0 0 0 150 50 0 0 20 0 1 0 99\n";
  std::filesystem::create_directories(folder.path() /
                                      "self/task/9");  // a thread that has just ended
  const auto threads = thread_loads(folder.path());
  ASSERT_EQ(threads.size(), 1U);
  EXPECT_EQ(threads[0].id, 712);
  EXPECT_EQ(threads[0].name, "odd) (name");
  EXPECT_NEAR(std::chrono::duration<double>(threads[0].time).count(),
              200.0 / static_cast<double>(::sysconf(_SC_CLK_TCK)), 1e-9);
}

TEST(ThreadLoads, ShowTheThreadsOfThisProcess) {
  hal::Thread thread;
  thread.wake();
  thread.start("bench test", [&thread] {
    while (thread.wait()) {
    }
  });
  const auto is_there = [] {
    const auto threads = thread_loads();
    return std::ranges::find(threads, "bench test", &ThreadLoad::name) != threads.end();
  };
  while (!is_there()) {  // the thread names itself
  }
  thread.stop();
  EXPECT_FALSE(is_there());
}

TEST(ThreadLoads, CountFromTheFirstReading) {
  using std::chrono::milliseconds;
  const std::vector<ThreadLoad> before{{1, "a", milliseconds(50)}};
  const auto rest = since(before, {{1, "a", milliseconds(70)}, {2, "new", milliseconds(10)}});
  EXPECT_EQ(rest,
            (std::vector<ThreadLoad>{{1, "a", milliseconds(20)}, {2, "new", milliseconds(10)}}));
}

TEST(MemoryFigures, AreThoseOfTheProcess) {
  const tests::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "self");
  std::ofstream(folder.path() / "self/status")
      << "VmLck:\t  1024 kB\nVmHWM:\t  4096 kB\nVmRSS:\t    2048 kB\nRssAnon:\t  512 kB\n";
  const MemoryFigures memory = memory_figures(folder.path());
  EXPECT_EQ(memory.resident, 2);
  EXPECT_EQ(memory.peak, 4);
  EXPECT_EQ(memory.anonymous, 0.5);
  EXPECT_EQ(memory.locked, 1);
  EXPECT_FALSE(signals::is_valid(memory.shared)) << "an old kernel";
}

}  // namespace
}  // namespace orbwatch::app::cli
