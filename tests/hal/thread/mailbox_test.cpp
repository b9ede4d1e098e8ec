// SPDX-License-Identifier: Apache-2.0
#include "hal/thread/mailbox.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

namespace orbwatch::hal {
namespace {

TEST(Mailbox, TheNewestWinsAndTheReplacedAreCounted) {
  Mailbox<int> box;
  EXPECT_TRUE(box.put(1));
  EXPECT_FALSE(box.put(2));
  EXPECT_FALSE(box.put(3));
  EXPECT_EQ(box.take(), 3);
  EXPECT_EQ(box.try_take(), std::nullopt);
  EXPECT_EQ(box.drops(), 2U);
}

TEST(Mailbox, TheSenderTakesBackWhatWasNotTaken) {
  Mailbox<std::shared_ptr<int>> box;
  const auto value = std::make_shared<int>(1);
  box.put(value);
  box.withdraw();
  EXPECT_EQ(value.use_count(), 1);
  EXPECT_EQ(box.drops(), 1U);
  EXPECT_EQ(box.try_take(), std::nullopt);
  box.withdraw();
  EXPECT_EQ(box.drops(), 1U) << "there was nothing";
  box.put(value);
  const auto taken = box.try_take();
  box.withdraw();
  EXPECT_EQ(value.use_count(), 2) << "the receiver's stays";
  EXPECT_EQ(box.drops(), 1U);
}

TEST(Mailbox, ClosingEndsAWait) {
  Mailbox<std::unique_ptr<int>> box;
  std::thread receiver([&] { EXPECT_FALSE(box.take().has_value()); });
  box.close();
  receiver.join();
}

TEST(Mailbox, EveryValueIsTakenOrCounted) {
  Mailbox<int> box;
  constexpr int kValues = 100000;
  int taken = 0, last = 0;
  std::thread receiver([&] {
    while (last < kValues) {
      const auto value = box.take();
      ASSERT_GT(*value, last) << "order";
      last = *value;
      ++taken;
    }
  });
  for (int i = 1; i <= kValues; ++i) {
    if (i % 3 == 0) box.withdraw();
    box.put(i);
  }
  receiver.join();
  EXPECT_EQ(taken + static_cast<int>(box.drops()), kValues);
}

}  // namespace
}  // namespace orbwatch::hal
