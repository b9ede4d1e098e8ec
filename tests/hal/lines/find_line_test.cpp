// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/find_line.h"

#include <gmock/gmock.h>

#include <cerrno>

namespace orbwatch::hal {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::vector<ChipInfo> two_chips() {
  return {{"/dev/gpiochip0",
           "pinctrl",
           {{0, "ID_SDA", false, true, "i2c"}, {1, "", false, false, ""}},
           ""},
          {"/dev/gpiochip3",
           "usb-io",
           {{0, "TRIGGER_IN", false, false, ""}, {1, "LASER_ON", false, true, ""}},
           ""}};
}

TEST(FindLine, ByNameAndByChipAndOffset) {
  const auto chips = two_chips();
  const auto named = find_line(chips, {.name = "TRIGGER_IN"});
  ASSERT_TRUE(named);
  EXPECT_EQ(named->chip->path, "/dev/gpiochip3");
  EXPECT_EQ(named->line->offset, 0U);
  const auto placed = find_line(chips, {.chip = "pinctrl", .offset = 1});
  ASSERT_TRUE(placed);
  EXPECT_EQ(placed->chip->path, "/dev/gpiochip0");
}

TEST(FindLine, AMissingOneTellsWhatThereIs) {
  auto chips = two_chips();
  chips.push_back({.path = "/dev/gpiochip4", .error = "/dev/gpiochip4: no permission"});
  const auto found = find_line(chips, {.name = "TRIGER_IN"});
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().message,
              AllOf(HasSubstr("TRIGER_IN"), HasSubstr("ID_SDA, TRIGGER_IN, LASER_ON"),
                    HasSubstr("usb-io (2 lines)"), HasSubstr("/dev/gpiochip4: no permission")));
  EXPECT_FALSE(find_line(chips, {.chip = "pinctrl", .offset = 2}));
  EXPECT_FALSE(find_line(chips, {.chip = "gpiochip0", .offset = 0})) << "a number is no address";
  EXPECT_THAT(find_line({}, {.name = "X"}).error().message, HasSubstr("there is no chip"));
}

TEST(FindLine, TwoOfAKindAreRefused) {
  auto chips = two_chips();
  chips[0].lines[1].name = "TRIGGER_IN";
  EXPECT_THAT(find_line(chips, {.name = "TRIGGER_IN"}).error().message,
              AllOf(HasSubstr("/dev/gpiochip0"), HasSubstr("/dev/gpiochip3")));
  chips = two_chips();
  chips[0].label = "usb-io";
  EXPECT_FALSE(find_line(chips, {.chip = "usb-io", .offset = 1}));
}

TEST(OpenError, NamesTheUser) {
  const auto chips = two_chips();
  const LineAddress address{.name = "ID_SDA"};
  EXPECT_THAT(open_error(*find_line(chips, address), address, EBUSY),
              AllOf(HasSubstr("ID_SDA"), HasSubstr("\"i2c\"")));
}

TEST(ChipError, NamesTheGroupThatMay) {
  EXPECT_THAT(chip_error("/proc/self/mem", EACCES), HasSubstr("the group root"));
  EXPECT_THAT(chip_error("/dev/none", ENODEV), HasSubstr("/dev/none: No such device"));
}

}  // namespace
}  // namespace orbwatch::hal
