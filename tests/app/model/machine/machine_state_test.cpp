// SPDX-License-Identifier: Apache-2.0
#include "app/model/machine/machine_state.h"

#include <gtest/gtest.h>

#include <limits>

namespace orbwatch::app {
namespace {

std::string refusal(const MachineState& state) {
  const auto checked = check(state);
  return checked ? "" : checked.error().message;
}

TEST(MachineState, WhatIsNotKnownIsAccepted) { EXPECT_EQ(refusal({}), ""); }

TEST(MachineState, ItsBoundsAreAccepted) {
  for (const MachineValue& value : kMachineValues) {
    for (const double bound : {value.minimum, value.maximum}) {
      MachineState state;
      state.values.*value.get = bound;
      EXPECT_EQ(refusal(state), "") << value.name;
    }
  }
}

TEST(MachineState, WhatIsOutsideIsRefusedByItsName) {
  const double infinite = std::numeric_limits<double>::infinity();
  for (const MachineValue& value : kMachineValues) {
    for (const double bad : {value.minimum - 1, value.maximum + 1, infinite, -infinite}) {
      MachineState state;
      state.values.*value.get = bad;
      EXPECT_TRUE(refusal(state).starts_with(std::string(value.name) + " is ")) << value.name;
    }
  }
  MachineState state;
  state.values.layer = 2.5;
  EXPECT_TRUE(refusal(state).ends_with("it must be a whole number, 0 to 2147483647"))
      << refusal(state);
  state = {};
  state.clock = -1;
  EXPECT_TRUE(refusal(state).starts_with("clock is out of range")) << refusal(state);
}

TEST(PartName, HoldsUpTo32BytesOfUtf8) {
  const std::string longest(32, 'x');
  EXPECT_EQ(PartName::make(longest)->text(), longest);
  EXPECT_EQ(PartName::make("Flügel 7")->text(), "Flügel 7");
  EXPECT_EQ(PartName::make("")->text(), "");
  EXPECT_EQ(*PartName::make("a"), *PartName::make("a"));
  EXPECT_NE(*PartName::make("a"), *PartName::make("b"));
}

TEST(PartName, RefusesWhatCannotBeShown) {
  for (const std::string& bad :
       {std::string(33, 'x'), std::string("\xff"), std::string("a\nb"), std::string("a\0b", 3),
        std::string("\xe2\x80\xae"
                    "abc"),
        std::string("\xc3")}) {
    EXPECT_FALSE(PartName::make(bad)) << bad;
  }
}

}  // namespace
}  // namespace orbwatch::app
