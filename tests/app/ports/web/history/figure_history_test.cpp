// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/history/figure_history.h"

#include <gmock/gmock.h>

#include "tests/app/ports/dds/test_status.h"

namespace orbwatch::app::web::tests {
namespace {

using app::tests::kRecipe;
using std::chrono::milliseconds;
using testing::ElementsAre;

MATCHER(IsNotMeasured, "") { return std::isnan(arg.low) && std::isnan(arg.high); }
MATCHER_P2(IsFrom, low, high, "") { return arg.low == float(low) && arg.high == float(high); }

constexpr std::uint16_t kOtherRecipe = kRecipe + 1;
const Component kWeld{"region", "weld"};

/// A history with a clock of the test's own.
class FigureHistoryTest : public testing::Test {
 protected:
  void SetUp() override { history.advance(now); }

  void measure(double width, std::uint16_t recipe = kRecipe) {
    Status status;
    status.recipe = recipe;
    status.region_count = 2;
    status.regions[0].signals.hot_spot_width = width;
    status.camera_count = 1;
    status.cameras[0].blur = width / 2;
    history.accept(status);
  }
  void pass(std::chrono::nanoseconds time = FigureHistory::kStep) { history.advance(now += time); }
  std::vector<Extremes> steps(const Component& component = kWeld,
                              std::string_view figure = "hot_spot_width") const {
    const auto series = history.series(component, figure);
    return series ? series->steps : std::vector<Extremes>();
  }

  StatusNames names = [] {
    StatusNames all = app::tests::make_names();
    all.regions[kOtherRecipe] = {"seam", "weld"};
    return all;
  }();
  FigureHistory history{names};
  hal::TimePoint now{std::chrono::hours(1)};
};

TEST_F(FigureHistoryTest, AStepHasTheExtremesOfItsStatuses) {
  for (const double width : {3.0, 9.0, 1.5, 2.0}) measure(width);
  measure(signals::kNotValid);
  pass();
  measure(4);
  pass();
  EXPECT_THAT(steps(), ElementsAre(IsFrom(1.5, 9), IsFrom(4, 4)));
  EXPECT_THAT(steps({"camera", "colour"}, "blur"), ElementsAre(IsFrom(0.75, 4.5), IsFrom(2, 2)));
  EXPECT_THAT(steps({"region", "edge"}), testing::Each(IsNotMeasured()));
  const auto series = history.series(kWeld, "hot_spot_width");
  EXPECT_EQ(series->unit, "mm");
  EXPECT_EQ(series->end, now);
}

TEST_F(FigureHistoryTest, NothingEndsBeforeItsTime) {
  measure(1);
  pass(FigureHistory::kStep - milliseconds(1));
  EXPECT_TRUE(steps().empty());
  measure(2);
  pass(milliseconds(1));
  EXPECT_THAT(steps(), ElementsAre(IsFrom(1, 2)));
}

TEST_F(FigureHistoryTest, SilenceIsAGap) {
  measure(1);
  pass();
  pass();
  pass(3 * FigureHistory::kStep + milliseconds(100));  // late
  measure(2);
  pass(milliseconds(400));
  EXPECT_THAT(steps(), ElementsAre(IsFrom(1, 1), IsNotMeasured(), IsNotMeasured(), IsNotMeasured(),
                                   IsNotMeasured(), IsFrom(2, 2)));
  EXPECT_EQ(history.series(kWeld, "hot_spot_width")->end, now) << "steps keep their beat";
}

TEST_F(FigureHistoryTest, IsBounded) {
  for (std::size_t i = 0; i < FigureHistory::kSteps + 7; ++i) {
    measure(static_cast<double>(i));
    pass();
  }
  const auto kept = steps();
  ASSERT_EQ(kept.size(), FigureHistory::kSteps);
  EXPECT_THAT(kept.front(), IsFrom(7, 7));
  EXPECT_THAT(kept.back(), IsFrom(FigureHistory::kSteps + 6, FigureHistory::kSteps + 6));
  pass(std::chrono::hours(1));
  EXPECT_EQ(steps().size(), FigureHistory::kSteps);
  EXPECT_THAT(steps(), testing::Each(IsNotMeasured()));
}

TEST_F(FigureHistoryTest, AnotherRecipeBeginsWhatItDoesNotShare) {
  measure(1);
  pass();
  measure(2);
  measure(3, kOtherRecipe);  // in the same step: weld is its second region
  pass();
  EXPECT_THAT(steps({"region", "seam"}), ElementsAre(IsNotMeasured(), IsFrom(3, 3)));
  EXPECT_THAT(steps(kWeld), ElementsAre(IsFrom(1, 1), IsNotMeasured()));
  EXPECT_TRUE(steps({"region", "edge"}).empty());
  EXPECT_THAT(steps({"camera", "colour"}, "blur").back(), IsFrom(1, 1.5)) << "cameras go on";
  measure(4);
  pass();
  EXPECT_THAT(steps({"region", "edge"}), testing::Each(IsNotMeasured()));
  EXPECT_THAT(steps(kWeld).back(), IsFrom(4, 4));
}

TEST_F(FigureHistoryTest, NamesWhatThereIs) {
  EXPECT_TRUE(history.components().empty());
  EXPECT_TRUE(history.series(kWeld, "hot_spot_width")->steps.empty());
  measure(1);
  pass();
  EXPECT_THAT(history.components(),
              ElementsAre(kWeld, Component{"region", "edge"}, Component{"camera", "colour"}));
  EXPECT_FALSE(history.series({"camera", "weld"}, "blur"));
  EXPECT_FALSE(history.series(kWeld, "blur"));
  EXPECT_FALSE(history.series({"view", "weld"}, "hot_spot_width"));
}

}  // namespace
}  // namespace orbwatch::app::web::tests
