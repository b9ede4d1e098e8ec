// SPDX-License-Identifier: Apache-2.0
#include "app/health/health_sampler.h"

#include <gtest/gtest.h>

#include <atomic>
#include <semaphore>
#include <thread>

namespace orbwatch::app {
namespace {

using signals::is_valid;
using std::chrono::milliseconds;

/// Board that returns 1, 2, 3 ... degrees, each when the test permits it.
class SlowBoard {
 public:
  std::function<Health()> reader() {
    return [this] {
      thread_ = std::this_thread::get_id();
      asked_.release();
      if (!lasting_) allowed_.acquire();
      Health health;
      health.board_temperature = ++readings_;
      return health;
    };
  }
  /// Returns when the next reading has begun, so the previous one was returned.
  void wait_until_asked() { asked_.acquire(); }
  void answer() { allowed_.release(); }
  /// Permits every reading from now on.
  void answer_always() {
    lasting_ = true;
    allowed_.release();
  }
  int readings() const { return readings_; }
  std::thread::id thread() const { return thread_; }

 private:
  std::counting_semaphore<> asked_{0};
  std::counting_semaphore<> allowed_{0};
  std::atomic<int> readings_{0};
  std::atomic<std::thread::id> thread_;
  std::atomic<bool> lasting_{false};
};

double temperature(const HealthSampler& sampler, hal::Clock::duration later = {}) {
  return sampler.latest(hal::Clock::now() + later).board_temperature;
}

TEST(HealthSampler, HandsOverTheNewestReading) {
  SlowBoard board;
  HealthSampler sampler(board.reader(), milliseconds(1));
  EXPECT_FALSE(is_valid(temperature(sampler)));
  sampler.start();
  board.wait_until_asked();
  EXPECT_FALSE(is_valid(temperature(sampler))) << "does not wait for the board";
  for (int reading = 1; reading <= 3; ++reading) {
    board.answer();
    board.wait_until_asked();
    EXPECT_EQ(temperature(sampler), reading);
  }
  EXPECT_NE(board.thread(), std::this_thread::get_id());
  board.answer_always();
}

TEST(HealthSampler, FiguresThatAreOldAreNotValid) {
  SlowBoard board;
  HealthSampler sampler(board.reader(), milliseconds(1));
  sampler.start();
  board.wait_until_asked();
  board.answer();
  board.wait_until_asked();
  EXPECT_EQ(temperature(sampler), 1);
  EXPECT_FALSE(is_valid(temperature(sampler, HealthSampler::kLongestAge)));
  board.answer_always();
}

TEST(HealthSampler, StopsAfterTheReadingThatIsUnderWayAndStartsAgain) {
  SlowBoard board;
  HealthSampler sampler(board.reader(), std::chrono::hours(1));
  sampler.start();
  sampler.start();
  board.wait_until_asked();
  board.answer();
  sampler.stop();
  sampler.stop();
  EXPECT_EQ(board.readings(), 1);
  EXPECT_EQ(temperature(sampler), 1);
  board.answer();
  sampler.start();
  board.wait_until_asked();
  sampler.stop();
  EXPECT_EQ(temperature(sampler), 2);
}

}  // namespace
}  // namespace orbwatch::app
