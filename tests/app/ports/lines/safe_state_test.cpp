// SPDX-License-Identifier: Apache-2.0
#include "app/ports/lines/safe_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/lines/simulated_lines.h"

namespace orbwatch::app {
namespace {

using testing::HasSubstr;

LineSettings named_line(const std::string& name, LineUse use, bool active_low = false) {
  LineSettings settings;
  settings.name = name;
  settings.use = use;
  settings.wire.address.name = name;
  settings.wire.active_low = active_low;
  return settings;
}

TEST(SafeState, OutputsThatWereLeftActiveBecomeInactive) {
  hal::SimulatedLines board({"OK", "ALARM", "DOOR"});
  board.drive("OK", true);
  board.drive("ALARM", false);
  board.drive("DOOR", true);
  const auto outputs =
      make_safe({named_line("OK", LineUse::ProcessOk), named_line("DOOR", LineUse::ProcessInput),
                 named_line("ALARM", LineUse::Alarm, true)},
                board);
  ASSERT_EQ(outputs.size(), 2U);
  EXPECT_EQ(outputs[0].error + outputs[1].error, "");
  EXPECT_FALSE(board.level("OK"));
  EXPECT_TRUE(board.level("ALARM")) << "active low";
  EXPECT_TRUE(board.level("DOOR")) << "an input is left alone";
}

TEST(SafeState, OneThatIsMissingHoldsUpNoOther) {
  hal::SimulatedLines board({"OK"});
  board.drive("OK", true);
  const auto outputs =
      make_safe({named_line("GONE", LineUse::Strobe), named_line("OK", LineUse::ProcessOk)}, board);
  ASSERT_EQ(outputs.size(), 2U);
  EXPECT_THAT(outputs[0].error, HasSubstr("GONE"));
  EXPECT_FALSE(board.level("OK"));
}

TEST(SafeState, SimulatedLinesEndedWithTheirProcess) {
  hal::SimulatedLines board({"OK"});
  LineSettings simulated = named_line("OK", LineUse::ProcessOk);
  simulated.back_end = LineKind::Simulated;
  EXPECT_TRUE(make_safe({simulated}, board).empty());
}

}  // namespace
}  // namespace orbwatch::app
