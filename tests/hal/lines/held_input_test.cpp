// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/held_input.h"

#include <gtest/gtest.h>

namespace orbwatch::hal {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kHold(500);

/// Input whose edges the test makes.
class HeldInputTest : public testing::Test {
 protected:
  void change_to(bool active, int ms) {
    state->set(active);
    held.on_edge({active ? Edge::Rising : Edge::Falling, at(ms)});
  }
  static TimePoint at(int ms) { return TimePoint(milliseconds(ms)); }
  int requests_at(int ms) {
    held.run(at(ms));
    return requests;
  }

  int requests = 0;
  std::shared_ptr<ProcessInput> state = std::make_shared<ProcessInput>(false);
  HeldInput held{kHold, state, [this] { ++requests; }};
};

TEST_F(HeldInputTest, AsksOnceWhenItWasHeldForLongEnough) {
  EXPECT_EQ(held.due(), TimePoint::max());
  change_to(true, 1000);
  EXPECT_EQ(held.due(), at(1500));
  EXPECT_EQ(requests_at(1499), 0);
  EXPECT_EQ(requests_at(1500), 1);
  EXPECT_EQ(held.due(), TimePoint::max());
  EXPECT_EQ(requests_at(9000), 1);
}

TEST_F(HeldInputTest, AsksAgainAfterItWasInactive) {
  change_to(true, 0);
  EXPECT_EQ(requests_at(500), 1);
  change_to(false, 600);
  change_to(true, 700);
  EXPECT_EQ(requests_at(1200), 2);
}

TEST_F(HeldInputTest, DoesNotAskAfterAShortPulse) {
  change_to(true, 0);
  change_to(false, 499);
  EXPECT_EQ(requests_at(500), 0);
  change_to(true, 600);
  EXPECT_EQ(requests_at(1099), 0) << "the time begins anew";
}

TEST_F(HeldInputTest, DoesNotAskWhenItIsActiveFromTheStartOn) {
  state->set(true);
  EXPECT_EQ(held.due(), TimePoint::max());
  EXPECT_EQ(requests_at(100000), 0);
}

TEST_F(HeldInputTest, WaitsForALineWithAFault) {
  change_to(true, 0);
  state->set(std::nullopt);
  EXPECT_EQ(requests_at(500), 0);
  EXPECT_EQ(held.due(), at(1000)) << "the time begins again";
  state->set(true);
  EXPECT_EQ(requests_at(1000), 1);
}

TEST_F(HeldInputTest, DoesNotAskWhenTheLineReturnsInactive) {
  change_to(true, 0);
  state->set(std::nullopt);
  EXPECT_EQ(requests_at(500), 0);
  change_to(false, 700);
  EXPECT_EQ(requests_at(5000), 0);
}

}  // namespace
}  // namespace orbwatch::hal
