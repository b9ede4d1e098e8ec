// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/state_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "tests/app/ports/recorder/export/recorded_event.h"
#include "tests/hal/recording/picture_file.h"

namespace orbwatch::app::recorder {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

/// Lines of a CSV without line breaks in its fields.
std::vector<std::string> lines_in(const std::filesystem::path& file) {
  std::istringstream text(tests::text_in(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

class StateTable : public tests::RecordedEventTest {};

TEST_F(StateTable, HasARowForEachFrameSetOfTheRange) {
  const auto done =
      write_state_table(recording, stamps(numbers(sets[1], sets[4])), folder / "states.csv", go_on);
  ASSERT_TRUE(done) << done.error().message;
  const auto lines = lines_in(folder / "states.csv");
  ASSERT_EQ(lines.size(), 1 + 4U);
  EXPECT_EQ(lines[0], "utc,utc_ns,frame_set,trigger,recipe") << "no region, no machine";
  const auto states = tests::read_recording(recording)["/orbwatch/process_state"];
  for (std::size_t row = 1; row < lines.size(); ++row) {
    const std::uint64_t set = sets[row];
    EXPECT_THAT(lines[row],
                EndsWith("Z," + std::to_string(states[row].log_time) + "," + std::to_string(set) +
                         "," + std::to_string(1000 + set) + ",0"));
  }
}

TEST_F(StateTable, IsCancelled) {
  const auto done = write_state_table(recording, {}, folder / "states.csv", cancel);
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message, HasSubstr("cancelled"));
}

TEST_F(StateTable, DamageIsAnError) {
  damage();
  EXPECT_FALSE(write_state_table(recording, {}, folder / "states.csv", go_on));
}

/// A recording of states that are the test's.
class WrittenStates : public testing::Test {
 protected:
  void write(const std::vector<std::vector<ComponentFigures>>& states) const {
    tests::PictureFile file(folder_ / "a.mcap");
    const auto channel = file.add("/orbwatch/process_state", hal::recording::SetNumbers::kType);
    std::uint64_t number = 0;
    for (const auto& components : states) {
      ProcessState state;
      state.frame_set = ++number;
      state.recipe = 3;
      state.components = components;
      file.write(channel, number * 1'000'000'000, static_cast<std::uint32_t>(number), state);
    }
    file.finish();
  }
  Result<> table() const {
    return write_state_table(folder_ / "a.mcap", {}, folder_ / "states.csv",
                             [](auto, auto, auto) { return true; });
  }

  const tests::TemporaryFolder folder_;
};

TEST_F(WrittenStates, HaveAColumnForEachValueOfAnyFrameSet) {
  const double none = std::nan("");
  write({{{"system", "", {{"process_active", 1, "", ""}}},
          {"region", "pool, left", {{"width", 5.25, "mm", ""}, {"area", none, "mm2", ""}}},
          {"machine", "", {{"part", none, "", "Flügel \"7\""}, {"layer", 12, "", ""}}}},
         {{"region", "seam", {{"width", 0.1, "mm", ""}}},
          {"alarm", "1, seam: width", {{"state", 1, "", "raised"}}}}});
  ASSERT_TRUE(table());
  EXPECT_THAT(lines_in(folder_ / "states.csv"),
              testing::ElementsAre(
                  "utc,utc_ns,frame_set,trigger,recipe,\"region.pool, left.width\","
                  "\"region.pool, left.area\",machine.part,machine.layer,region.seam.width",
                  "1970-01-01T00:00:01.000000000Z,1000000000,1,,3,5.25,,\"Flügel \"\"7\"\"\",12,",
                  "1970-01-01T00:00:02.000000000Z,2000000000,2,,3,,,,,0.1"));
}

TEST_F(WrittenStates, MayGoBackwards) {
  tests::PictureFile file(folder_ / "a.mcap");
  const auto channel = file.add("/orbwatch/process_state", hal::recording::SetNumbers::kType);
  for (const std::uint64_t number : {1U, 2U, 3U, 4U}) {
    ProcessState state;
    state.frame_set = number;
    const std::uint64_t stamp = number == 2 ? 900 : 1000 * number;
    file.write(channel, stamp, static_cast<std::uint32_t>(number), state);
  }
  file.finish();
  const ExportRange to_third{{}, RangeEnd{false, 3}};
  const auto range = stamps_in(folder_ / "a.mcap", to_third);
  ASSERT_TRUE(range) << range.error().message;
  EXPECT_EQ(range->sets, 3U);
  ASSERT_TRUE(write_state_table(folder_ / "a.mcap", *range, folder_ / "states.csv",
                                [](auto, auto, auto) { return true; }));
  EXPECT_THAT(lines_in(folder_ / "states.csv"),
              testing::ElementsAre(testing::_, EndsWith(",1000,1,,0"), EndsWith(",900,2,,0"),
                                   EndsWith(",3000,3,,0")));
  const ExportRange second{RangeEnd{false, 2}, RangeEnd{false, 2}};
  EXPECT_EQ(stamps_in(folder_ / "a.mcap", second)->first, 900U);
}

TEST_F(WrittenStates, OfMoreValuesThanATableCanHaveAreRefused) {
  std::vector<Figure> figures(5000);
  for (std::size_t k = 0; k < figures.size(); ++k) figures[k].name = std::to_string(k);
  write({{{"region", "pool", figures}}});
  const auto many = table();
  ASSERT_FALSE(many);
  EXPECT_THAT(many.error().message, HasSubstr("more than 4096 values"));
  std::filesystem::remove(folder_ / "a.mcap");
  write({{{"region", std::string(2000, 'x'), {{"width", 1, "", ""}}}}});
  EXPECT_FALSE(table());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "states.csv"));
}

}  // namespace
}  // namespace orbwatch::app::recorder
