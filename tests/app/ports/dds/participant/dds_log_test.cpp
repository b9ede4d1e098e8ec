// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/participant/dds_log.h"

#include <dds/dds.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace orbwatch::app::dds {
namespace {

/// Each of these makes Cyclone DDS log at least one error.
bool refuses_bad_domains() {
  bool all = true;
  for (int i = 0; i < 100; ++i) {
    all &= dds_create_domain(static_cast<dds_domainid_t>(100 + i),
                             "<CycloneDDS><Domain><Unknown/>") < 0;
  }
  return all;
}

std::ptrdiff_t lines(const std::string& log) { return std::count(log.begin(), log.end(), '\n'); }

/// Runs in a separate process, because other tests may have used up the limit of this minute.
TEST(LimitDdsLogDeathTest, WhatCycloneLogsArrivesAndIsLimited) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        limit_dds_log();
        std::exit(refuses_bad_domains() ? 0 : 1);
      },
      testing::ExitedWithCode(0),
      testing::AllOf(testing::StartsWith("orbwatch: DDS: "),
                     testing::ResultOf("lines", lines, testing::Le(20))));
}

}  // namespace
}  // namespace orbwatch::app::dds
