// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/replay/comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "app/model/status/status.h"

/// Recorded and computed states of the process, compared.
namespace orbwatch::app::daemon {
namespace {

using recorder::ProcessState;

constexpr double kMeasured = static_cast<double>(Quality::Good);
constexpr double kNotMeasured = static_cast<double>(Quality::NotMeasured);

ProcessState state(double quality, double width, double alarm, double age = 0) {
  ProcessState state;
  state.components.push_back({"system", "", {{"heartbeat", age, "", ""}}});
  state.components.push_back(
      {"region", "weld", {{"quality", quality, "", ""}, {"width", width, "mm", ""}}});
  state.components.push_back(
      {"alarm", "1, weld: width", {{"state", alarm, "", ""}, {"since_age", age, "s", ""}}});
  return state;
}

/// Differences between two sequences of states, as figures.
std::vector<std::string> differences(const std::vector<ProcessState>& recorded,
                                     const std::vector<ProcessState>& computed,
                                     double tolerance = 0) {
  std::vector<std::string> figures;
  Comparison comparison(tolerance, {}, [&](const Difference& difference) {
    figures.push_back(difference.kind + " " + difference.figure + " " +
                      std::to_string(difference.utc));
  });
  for (std::size_t k = 0; k < recorded.size(); ++k) comparison.add(k, recorded[k], computed[k]);
  const std::size_t counted = comparison.finish().differences;
  EXPECT_EQ(counted, figures.size());
  return figures;
}

using Figures = std::vector<std::string>;

TEST(Comparison, IsExactUnlessATolerance) {
  const double next = std::nextafter(5.0, 6);
  EXPECT_EQ(differences({state(kMeasured, 5, 0)}, {state(kMeasured, 5, 0)}), Figures());
  EXPECT_EQ(differences({state(kMeasured, 5, 0)}, {state(kMeasured, next, 0)}),
            Figures{"region width 0"});
  EXPECT_EQ(differences({state(kMeasured, 5, 0)}, {state(kMeasured, 5.04, 0)}, 0.01), Figures());
  EXPECT_EQ(differences({state(kMeasured, 5, 0)}, {state(kMeasured, 5.06, 0)}, 0.01),
            Figures{"region width 0"});
}

TEST(Comparison, ValuesThatAreNotValidAreTheSame) {
  const double none = std::nan("");
  EXPECT_EQ(differences({state(kMeasured, none, 0)}, {state(kMeasured, none, 0)}), Figures());
  EXPECT_EQ(differences({state(kMeasured, none, 0)}, {state(kMeasured, 0, 0)}, 0.5),
            Figures{"region width 0"});
}

TEST(Comparison, LeavesOutAgesTheSystemAndWhatWasNotMeasured) {
  EXPECT_EQ(differences({state(kMeasured, 5, 0, 1)}, {state(kMeasured, 5, 0, 2)}), Figures());
  EXPECT_EQ(differences({state(kNotMeasured, std::nan(""), 0)}, {state(kMeasured, 5, 0)}),
            Figures());
  EXPECT_EQ(differences({state(kMeasured, 5, 0)}, {state(kNotMeasured, 5, 0)}),
            Figures{"region quality 0"});
}

std::vector<ProcessState> alarms(const std::vector<double>& values) {
  std::vector<ProcessState> states;
  for (const double value : values) states.push_back(state(kMeasured, 5, value));
  return states;
}

TEST(Comparison, AnAlarmMayChangeASetEarlierOrLater) {
  const auto recorded = alarms({0, 0, 1, 1, 1});
  EXPECT_EQ(differences(recorded, alarms({0, 0, 0, 1, 1})), Figures());
  EXPECT_EQ(differences(recorded, alarms({0, 1, 1, 1, 1})), Figures());
  EXPECT_EQ(differences(recorded, alarms({0, 0, 0, 0, 1})), Figures{"alarm state 3"});
  EXPECT_EQ(differences(recorded, alarms({1, 1, 1, 1, 1})), Figures{"alarm state 0"});
  EXPECT_EQ(differences(recorded, alarms({0, 0, 1, 1, 2})), Figures{"alarm state 4"});
}

TEST(Comparison, NamesWhatOneSideHasAlone) {
  ProcessState other = state(kMeasured, 5, 0);
  other.components[1].name = "seam";
  Comparison comparison(0, {}, [](const Difference&) { FAIL(); });
  comparison.add(0, state(kMeasured, 5, 0), other);
  EXPECT_EQ(comparison.finish().missing, (std::set<std::string>{"region seam", "region weld"}));
}

/// A state with the hot spot's width in a region, and an alarm on it.
ProcessState width_of(double width, double alarm) {
  ProcessState state;
  state.recipe = 3;
  state.components.push_back({"region",
                              "weld",
                              {{"quality", kMeasured, "", ""},
                               {"hot_spot_width", width, "mm", ""},
                               {"spatter_speed", width, "deg/s", ""}}});
  state.components.push_back(
      {"alarm", "1, weld: hot_spot_width", {{"state", alarm, "", ""}, {"value", width, "mm", ""}}});
  return state;
}

TEST(Comparison, NamesDifferencesThatJpegExplains) {
  const auto compare = [](const JpegQualities& qualities, double alarm) {
    std::vector<std::string> explained;
    Comparison comparison(0, qualities, [&](const Difference& difference) {
      explained.push_back((difference.is_of_jpeg ? "jpeg " : "") + difference.figure);
    });
    // An alarm's values are settled by the next set.
    comparison.add(0, width_of(10, 0), width_of(10.1, alarm));
    comparison.add(1, width_of(12, 0), width_of(12, 0));
    const ComparisonCounts& counts = comparison.finish();
    EXPECT_EQ(counts.differences + counts.of_jpeg, explained.size());
    return explained;
  };
  EXPECT_EQ(compare({{{3, "weld"}, 90}}, 0),
            (Figures{"jpeg hot_spot_width", "spatter_speed", "jpeg value"}));
  EXPECT_EQ(compare({{{3, "weld"}, 90}}, 2),
            (Figures{"jpeg hot_spot_width", "spatter_speed", "state", "jpeg value"}))
      << "no state of an alarm";
  for (const JpegQualities& none :
       {JpegQualities{}, JpegQualities{{{3, "weld"}, 75}}, JpegQualities{{{3, "other"}, 90}},
        JpegQualities{{{1, "weld"}, 90}}}) {
    EXPECT_EQ(compare(none, 0), (Figures{"hot_spot_width", "spatter_speed", "value"}));
  }
}

}  // namespace
}  // namespace orbwatch::app::daemon
