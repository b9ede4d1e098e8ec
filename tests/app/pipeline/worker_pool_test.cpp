#include "app/pipeline/worker_pool.h"

#include <gtest/gtest.h>

#include <array>

namespace orbwatch::app {
namespace {

TEST(WorkerPool, DoesEachBandOnceAndAllBeforeItReturns) {
  for (const std::size_t threads : {0, 1, 4}) {
    WorkerPool pool(threads);
    for (int round = 0; round < 500; ++round) {
      std::array<int, 37> done{};
      auto work = [&](int band) { ++done[static_cast<std::size_t>(band)]; };
      pool.run(static_cast<int>(done.size()), work);
      for (const int times : done) ASSERT_EQ(times, 1) << threads << " threads, round " << round;
    }
  }
}

TEST(WorkerPool, NothingToDoIsDoneAtOnce) {
  WorkerPool pool(2);
  auto work = [](int) { FAIL(); };
  pool.run(0, work);
}

}  // namespace
}  // namespace orbwatch::app
