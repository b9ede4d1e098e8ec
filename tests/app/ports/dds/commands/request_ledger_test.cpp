// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/commands/request_ledger.h"

#include <gtest/gtest.h>

namespace orbwatch::app::dds {
namespace {

using Verdict = RequestLedger::Verdict;

const CommandAnswer kBusy{CommandResult::Busy, "busy"};
const CommandAnswer kDone{CommandResult::Done, "done"};

TEST(RequestLedgerTest, TellsNewFromRepeatedAndLate) {
  RequestLedger ledger(4);
  EXPECT_EQ(ledger.judge({1, 5}), Verdict::New);
  ledger.record({1, 5}, kBusy);
  EXPECT_EQ(ledger.judge({1, 5}), Verdict::Again);
  EXPECT_EQ(ledger.answer({1, 5}), kBusy);
  EXPECT_EQ(ledger.judge({1, 4}), Verdict::Late);
  EXPECT_EQ(ledger.judge({1, 6}), Verdict::New);
  EXPECT_EQ(ledger.judge({2, 4}), Verdict::New) << "another client";
  ledger.record({1, 6}, kDone);
  EXPECT_EQ(ledger.answer({1, 6}), kDone);
  EXPECT_EQ(ledger.judge({1, 5}), Verdict::Late);
}

TEST(RequestLedgerTest, ForgetsWhoAskedLongestAgo) {
  RequestLedger ledger(3);
  for (std::uint64_t client : {1, 2, 3}) ledger.record({client, 9}, kDone);
  ledger.record({1, 10}, kDone);
  ledger.record({4, 9}, kDone);
  EXPECT_EQ(ledger.judge({2, 9}), Verdict::New) << "forgotten";
  EXPECT_EQ(ledger.judge({3, 9}), Verdict::Again);
  EXPECT_EQ(ledger.judge({1, 10}), Verdict::Again);
  EXPECT_EQ(ledger.judge({4, 9}), Verdict::Again);
}

}  // namespace
}  // namespace orbwatch::app::dds
