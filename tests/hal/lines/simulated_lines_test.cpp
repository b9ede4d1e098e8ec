// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/simulated_lines.h"

#include <gmock/gmock.h>
#include <poll.h>

#include <array>

#include "tests/hal/lines/edges.h"

namespace orbwatch::hal {
namespace {

using testing::HasSubstr;

bool is_readable(int file) {
  pollfd poll{file, POLLIN, 0};
  return ::poll(&poll, 1, 0) == 1;
}

std::vector<EdgeEvent> take_all(DigitalInput& input) {
  std::vector<EdgeEvent> all;
  std::array<EdgeEvent, 3> some;
  for (std::size_t count = 1; count > 0;) {
    count = input.take(some).value();
    all.insert(all.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return all;
}

TEST(SimulatedLines, EdgesComeInOrderAndTheFileSaysSo) {
  SimulatedLines lines({"IN"});
  const auto input = lines.open_input({.address = {.name = "IN"}}).value();
  EXPECT_FALSE(is_readable(input->descriptor()));
  const std::vector<std::pair<bool, TimePoint>> script{
      {true, at(1)}, {true, at(2)}, {false, at(3)}, {true, at(4)}, {false, at(5)}};
  for (const auto& [level, stamp] : script) lines.drive("IN", level, stamp);
  EXPECT_TRUE(is_readable(input->descriptor()));
  EXPECT_EQ(take_all(*input), (std::vector<EdgeEvent>{{Edge::Rising, at(1)},
                                                      {Edge::Falling, at(3)},
                                                      {Edge::Rising, at(4)},
                                                      {Edge::Falling, at(5)}}));
  EXPECT_FALSE(is_readable(input->descriptor()));
}

TEST(SimulatedLines, ActiveLowTurnsLevelsAndEdges) {
  SimulatedLines lines({"IN", "OUT"});
  const auto input = lines.open_input({.address = {.name = "IN"}, .active_low = true}).value();
  EXPECT_TRUE(input->level().value());
  lines.drive("IN", true, at(1));
  EXPECT_EQ(take_all(*input).front(), (EdgeEvent{Edge::Falling, at(1)}));
  auto output = lines.open_output({.address = {.name = "OUT"}, .active_low = true}).value();
  EXPECT_TRUE(lines.level("OUT")) << "inactive from the beginning";
  ASSERT_TRUE(output->set(true));
  EXPECT_FALSE(lines.level("OUT"));
  output.reset();
  EXPECT_TRUE(lines.level("OUT")) << "inactive in the end";
}

TEST(SimulatedLines, AnOutputAndAnInputOfOneLineAreAWire) {
  SimulatedLines lines({"WIRE"});
  const auto input = lines.open_input({.address = {.name = "WIRE"}}).value();
  const auto output = lines.open_output({.address = {.chip = "simulated", .offset = 0}}).value();
  ASSERT_TRUE(output->set(true));
  EXPECT_TRUE(input->level().value());
  EXPECT_EQ(take_all(*input).size(), 1U);
}

TEST(SimulatedLines, AFullQueueDropsTheNewest) {
  SimulatedLines lines({"IN"});
  const auto input = lines.open_input({.address = {.name = "IN"}}).value();
  for (int i = 0; i < 21; ++i) lines.drive("IN", i % 2 == 0, at(i));
  const auto edges = take_all(*input);
  ASSERT_EQ(edges.size(), SimulatedLines::kQueue);
  EXPECT_EQ(edges.back().stamp, at(15));
  EXPECT_TRUE(input->level().value()) << "only the level knows how it ended";
}

TEST(SimulatedLines, ALineThatIsGoneLosesItsEdgesUntilItIsBack) {
  SimulatedLines lines({"IN"});
  auto input = lines.open_input({.address = {.name = "IN"}}).value();
  std::array<EdgeEvent, 4> edges;
  lines.drive("IN", true, at(0));
  EXPECT_EQ(input->take(edges).value(), 1U);
  lines.fail_with("IN", LineFault::Gone);
  EXPECT_TRUE(is_readable(input->descriptor())) << "as a chip that goes";
  lines.drive("IN", false, at(1));
  EXPECT_EQ(input->take(edges).error().fault, LineFault::Gone);
  EXPECT_FALSE(input->level());
  input.reset();
  EXPECT_THAT(lines.open_input({.address = {.name = "IN"}}).error().message, HasSubstr("IN"));
  lines.fail_with("IN", LineFault::None);
  EXPECT_TRUE(lines.open_input({.address = {.name = "IN"}}));
}

TEST(SimulatedLines, AreListedWithTheirUsers) {
  SimulatedLines lines({"IN", "OUT", "FREE"});
  const auto input = lines.open_input({.address = {.name = "IN"}}).value();
  const auto output = lines.open_output({.address = {.name = "OUT"}}).value();
  const auto chips = lines.chips();
  ASSERT_EQ(chips.size(), 1U);
  EXPECT_EQ(chips[0].label, "simulated");
  EXPECT_EQ(chips[0].lines[0].consumer, "orbwatch");
  EXPECT_TRUE(chips[0].lines[1].is_output);
  EXPECT_FALSE(chips[0].lines[2].is_used);
  EXPECT_THAT(lines.open_input({.address = {.name = "IN"}}).error().message,
              HasSubstr("\"orbwatch\""));
  EXPECT_THAT(lines.open_output({.address = {.name = "NO"}}).error().message,
              HasSubstr("IN, OUT, FREE"));
}

}  // namespace
}  // namespace orbwatch::hal
