// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/history/figure_table.h"

#include <gmock/gmock.h>

#include <sstream>

#include "tests/app/ports/dds/test_status.h"

namespace orbwatch::app::web::tests {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::vector<std::string> lines_of(const std::string& table) {
  std::vector<std::string> lines;
  std::istringstream in(table);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

void measure(FigureHistory& history, double width) {
  Status status;
  status.recipe = app::tests::kRecipe;
  status.region_count = 2;
  status.regions[0].signals.hot_spot_width = width;
  history.accept(status);
}

TEST(FigureTable, HasALineForEachStep) {
  FigureHistory history(app::tests::make_names());
  hal::TimePoint now = hal::Clock::now();
  history.advance(now);
  for (const double width : {1.5, signals::kNotValid, 2.25}) {
    measure(history, width);
    history.advance(now += FigureHistory::kStep);
  }
  const std::vector<std::string> lines = lines_of(figure_table(history));
  ASSERT_EQ(lines.size(), 4U);
  // The quality of a region is a number also where its figures are not measured.
  EXPECT_EQ(lines[0],
            "end,region weld: quality low,region weld: quality high,"
            "region weld: hot_spot_width low (mm),region weld: hot_spot_width high (mm),"
            "region edge: quality low,region edge: quality high\r");
  EXPECT_THAT(lines[1], AllOf(StartsWith("20"), EndsWith("Z,0,0,1.5,1.5,0,0\r")));
  EXPECT_THAT(lines[2], EndsWith("Z,0,0,,,0,0\r"));
  EXPECT_THAT(lines[3], EndsWith("Z,0,0,2.25,2.25,0,0\r"));
  EXPECT_LT(lines[1].substr(0, 30), lines[2].substr(0, 30));
}

TEST(FigureTable, WithoutMeasurementsIsItsHead) {
  FigureHistory history(app::tests::make_names());
  EXPECT_EQ(figure_table(history), "end\r\n");
}

TEST(FigureTable, QuotesNames) {
  StatusNames names = app::tests::make_names();
  names.regions[app::tests::kRecipe] = {"a \"weld\", the first", "edge"};
  FigureHistory history(names);
  hal::TimePoint now = hal::Clock::now();
  history.advance(now);
  measure(history, 1);
  history.advance(now + FigureHistory::kStep);
  EXPECT_THAT(figure_table(history),
              HasSubstr("\"region a \"\"weld\"\", the first: hot_spot_width low (mm)\""));
}

}  // namespace
}  // namespace orbwatch::app::web::tests
