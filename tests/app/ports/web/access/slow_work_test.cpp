// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/slow_work.h"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <new>
#include <string>
#include <thread>
#include <vector>

namespace orbwatch::app::web::tests {
namespace {

/// A desk whose thread is blocked until the test releases it.
class SlowWorkTest : public testing::Test {
 protected:
  void SetUp() override {
    work.start();
    std::promise<void> begun;
    submit({true, "first"}, [this, &begun] {
      begun.set_value();
      go_on.get_future().wait();
    });
    begun.get_future().wait();
  }
  void TearDown() override { finish(); }

  ExchangePtr submit(
      const SlowWork::Asker& asker, const std::function<void()>& act = [] {}) {
    const auto exchange = std::make_shared<Exchange>(Request{});
    work.run(exchange, asker, [this, act, key = asker.key] {
      act();
      served.push_back(key);
      return json_response("{}");
    });
    submitted.push_back(exchange);
    return exchange;
  }
  bool is_refused(const SlowWork::Asker& asker) {
    const ExchangePtr exchange = submit(asker);
    return exchange->is_answered();
  }
  /// Waits until all requests are answered.
  void finish() {
    if (is_finished) return;
    is_finished = true;
    go_on.set_value();
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    for (const ExchangePtr& exchange : submitted) {
      while (!exchange->is_answered()) {
        ASSERT_LT(std::chrono::steady_clock::now(), give_up);
        std::this_thread::yield();
      }
    }
    work.stop();
  }

  SlowWork work{"slow work test", "busy"};
  std::promise<void> go_on;
  bool is_finished = false;
  std::vector<ExchangePtr> submitted;
  std::vector<std::string> served;  ///< served by the thread; read after finish()
};

TEST_F(SlowWorkTest, UnknownClientsDoNotKeepKnownOnesOut) {
  for (std::size_t i = 0; i < SlowWork::kMostWaiting; ++i) {
    EXPECT_FALSE(is_refused({false, "10.0.0." + std::to_string(i)}));
  }
  EXPECT_TRUE(is_refused({false, "10.0.0.99"}));
  EXPECT_FALSE(is_refused({true, "kim"}));
}

TEST_F(SlowWorkTest, OneAskerTakesAPartOfTheQueue) {
  for (std::size_t i = 0; i < SlowWork::kMostOfUnknown; ++i) {
    EXPECT_FALSE(is_refused({false, "10.0.0.1"}));
  }
  EXPECT_TRUE(is_refused({false, "10.0.0.1"}));
  EXPECT_FALSE(is_refused({false, "10.0.0.2"}));
  for (std::size_t i = 0; i < SlowWork::kMostOfKnown; ++i) EXPECT_FALSE(is_refused({true, "kim"}));
  EXPECT_TRUE(is_refused({true, "kim"}));
  EXPECT_FALSE(is_refused({true, "lee"}));
}

TEST_F(SlowWorkTest, ARequestWithoutMemoryIsRefusedAndTheNextOneIsServed) {
  const ExchangePtr refused = submit({true, "kim"}, [] { throw std::bad_alloc(); });
  submit({true, "lee"});
  finish();
  const auto response = refused->response_or_suspend(nullptr);
  ASSERT_TRUE(response);
  EXPECT_EQ(response->status, 503);
  EXPECT_NE(response->body->find("not enough memory"), std::string::npos) << *response->body;
  EXPECT_EQ(served, (std::vector<std::string>{"first", "lee"}));
}

TEST_F(SlowWorkTest, TheQueuesAreServedInTurn) {
  for (const char* address : {"10.0.0.1", "10.0.0.2"}) submit({false, address});
  for (const char* name : {"kim", "lee"}) submit({true, name});
  finish();
  EXPECT_EQ(served, (std::vector<std::string>{"first", "10.0.0.1", "kim", "10.0.0.2", "lee"}));
}

}  // namespace
}  // namespace orbwatch::app::web::tests
