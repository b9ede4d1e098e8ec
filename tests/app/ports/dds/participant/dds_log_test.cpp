#include "app/ports/dds/participant/dds_log.h"

#include <dds/dds.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

namespace orbwatch::app {
namespace {

TEST(LimitDdsLogTest, WhatCycloneLogsArrivesAndIsLimited) {
  limit_dds_log();
  testing::internal::CaptureStderr();
  // Each of these makes Cyclone DDS log at least one error.
  for (int i = 0; i < 100; ++i) {
    EXPECT_LT(
        dds_create_domain(static_cast<dds_domainid_t>(100 + i), "<CycloneDDS><Domain><Unknown/>"),
        0);
  }
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_LE(std::count(log.begin(), log.end(), '\n'), 20) << log;
  // A repetition within the minute finds the budget spent.
  static bool repeated = false;
  if (!std::exchange(repeated, true)) {
    EXPECT_EQ(log.rfind("orbwatch: DDS: ", 0), 0u) << log;
  }
}

}  // namespace
}  // namespace orbwatch::app
