// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/watched_input.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "tests/hal/lines/edges.h"

namespace orbwatch::hal {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::IsEmpty;

/// Wire whose level is known at any time, and the edges that a filter returns for it.
class Wire {
 public:
  explicit Wire(Clock::duration period) : filter(period, false) {}

  void change(double when, bool to) { edges.push_back({edge_to(to), at(when)}); }

  /// Handles everything up to `end`, like a line thread that is never late.
  std::vector<EdgeEvent> run(double end) {
    std::vector<EdgeEvent> out;
    const auto keep = [&out](const std::optional<EdgeEvent>& edge) {
      if (edge) out.push_back(*edge);
    };
    for (const EdgeEvent& edge : edges) {
      settle_until(edge.stamp, keep);
      level = edge.edge == Edge::Rising;
      keep(filter.take(edge));
    }
    settle_until(at(end), keep);
    return out;
  }

  EdgeFilter filter;
  std::vector<EdgeEvent> edges;
  bool level = false;

 private:
  template <class Keep>
  void settle_until(TimePoint end, const Keep& keep) {
    while (filter.due() < end) keep(filter.settle(level, filter.due()));
  }
};

TEST(EdgeFilter, PassesEdgesAtOnceWithoutAPeriod) {
  Wire wire{Clock::duration(0)};
  wire.change(1, true);
  wire.change(1.001, false);
  wire.change(1.002, true);
  EXPECT_EQ(wire.run(100), wire.edges);
  EXPECT_EQ(wire.filter.lost(), 0U);
}

TEST(EdgeFilter, ABurstIsOneEdgeAtItsLastChange) {
  Wire wire{milliseconds(2)};
  for (int i = 0; i < 9; ++i) wire.change(10 + i * 0.5, i % 2 == 0);
  wire.change(30, false);
  EXPECT_THAT(wire.run(100),
              ElementsAre(EdgeEvent{Edge::Rising, at(14)}, EdgeEvent{Edge::Falling, at(30)}));
}

TEST(EdgeFilter, APulseShorterThanThePeriodIsNone) {
  Wire wire{milliseconds(2)};
  wire.change(10, true);
  wire.change(11.99, false);
  EXPECT_THAT(wire.run(100), IsEmpty());
}

TEST(EdgeFilter, APulseOfThePeriodIsOneHoweverLateItIsRead) {
  EdgeFilter filter(milliseconds(2), false);
  EXPECT_EQ(filter.take({Edge::Rising, at(10)}), std::nullopt);
  EXPECT_EQ(filter.take({Edge::Falling, at(12)}), (EdgeEvent{Edge::Rising, at(10)}));
  EXPECT_EQ(filter.settle(false, at(50)), (EdgeEvent{Edge::Falling, at(12)}));
}

TEST(EdgeFilter, AsksAgainWhenTheLevelContradictsTheLastEdge) {
  EdgeFilter filter(milliseconds(2), false);
  filter.take({Edge::Rising, at(10)});
  EXPECT_EQ(filter.settle(false, at(12)), std::nullopt) << "its edge may be on the way";
  EXPECT_EQ(filter.due(), at(14));
  EXPECT_EQ(filter.take({Edge::Falling, at(12.5)}), (EdgeEvent{Edge::Rising, at(10)}));
  EXPECT_EQ(filter.settle(false, at(15)), (EdgeEvent{Edge::Falling, at(12.5)}));
  EXPECT_EQ(filter.lost(), 0U);
}

TEST(EdgeFilter, ALostLastEdgeIsFoundByTheLevel) {
  for (const auto period : {Clock::duration(0), Clock::duration(milliseconds(2))}) {
    Wire wire{period};
    wire.change(10, true);
    wire.change(20, false);
    wire.change(30, true);
    auto out = wire.run(31.5);
    wire.level = false;  // without an edge that shows it
    const bool passed = out.size() == 3;
    EXPECT_EQ(passed, period.count() == 0);
    for (int i = 0; i < 2; ++i) {
      if (const auto edge = wire.filter.settle(false, wire.filter.due())) out.push_back(*edge);
    }
    ASSERT_FALSE(out.empty());
    EXPECT_EQ(out.back().edge, Edge::Falling) << "the final state is right";
    EXPECT_EQ(wire.filter.lost(), 1U);
    EXPECT_EQ(wire.filter.due(), TimePoint::max());
  }
}

TEST(EdgeFilter, AnEdgeThatComesAfterItsLevelToldOfItChangesNothing) {
  for (const auto period : {Clock::duration(0), Clock::duration(milliseconds(5))}) {
    EdgeFilter filter(period, false);
    filter.take({Edge::Rising, at(10)});
    filter.settle(true, at(15));
    filter.take({Edge::Falling, at(20)});
    filter.settle(true, at(25));
    EXPECT_EQ(filter.settle(true, at(30)),
              period.count() > 0 ? std::nullopt : std::optional(EdgeEvent{Edge::Rising, at(30)}));
    EXPECT_EQ(filter.take({Edge::Rising, at(24)}), std::nullopt) << "it was on its way for 6 ms";
    EXPECT_EQ(filter.settle(true, filter.due()), std::nullopt);
    EXPECT_EQ(filter.take({Edge::Falling, at(40)}),
              period.count() > 0 ? std::nullopt : std::optional(EdgeEvent{Edge::Falling, at(40)}));
    EXPECT_EQ(filter.lost(), 1U);
  }
}

TEST(EdgeFilter, AShortPulseIsOneHoweverItsEdgesAreNamed) {
  EdgeFilter filter(Clock::duration(0), false);
  EXPECT_EQ(filter.take({Edge::Falling, at(1)}), (EdgeEvent{Edge::Rising, at(1)}));
  EXPECT_EQ(filter.take({Edge::Falling, at(1.01)}), (EdgeEvent{Edge::Falling, at(1.01)}));
  EXPECT_EQ(filter.settle(false, filter.due()), std::nullopt);
  EXPECT_EQ(filter.lost(), 0U);
}

TEST(EdgeFilter, AfterNumberedLossesTheDirectionIsRightAtOnce) {
  for (const unsigned lost : {1U, 2U, 7U, 40U}) {
    EdgeFilter filter(Clock::duration(0), false);
    filter.take({Edge::Rising, at(1)});
    const bool level = lost % 2 == 1;  // level after the first edge that follows the lost ones
    EXPECT_EQ(filter.take({edge_to(level), at(2), lost}), (EdgeEvent{edge_to(level), at(2)}));
    EXPECT_EQ(filter.take({edge_to(!level), at(3)}), (EdgeEvent{edge_to(!level), at(3)}));
    EXPECT_EQ(filter.lost(), lost);
  }
}

TEST(EdgeFilter, ALossThatNoNumberNamesIsFoundByThreeReadings) {
  EdgeFilter filter(Clock::duration(0), false);
  EXPECT_FALSE(filter.in_doubt());
  filter.take({Edge::Rising, at(1)});
  filter.doubt();
  EXPECT_EQ(filter.confirm(false, at(1.1)), std::nullopt) << "its edge may be on the way";
  EXPECT_EQ(filter.confirm(false, at(1.2)), std::nullopt);
  EXPECT_EQ(filter.confirm(false, at(1.3)), (EdgeEvent{Edge::Falling, at(1.3)}));
  EXPECT_FALSE(filter.in_doubt());
  EXPECT_EQ(filter.lost(), 1U);
}

TEST(EdgeFilter, AnEdgeThatMakesUpForALostOneIsNoOlderThanTheLastOne) {
  EdgeFilter filter(Clock::duration(0), false);
  filter.take({Edge::Rising, at(2)});
  filter.doubt();
  filter.confirm(false, at(1));
  filter.confirm(false, at(1));
  EXPECT_EQ(filter.confirm(false, at(1)), (EdgeEvent{Edge::Falling, at(2)}));
}

TEST(EdgeFilter, AReadingThatIsAheadOfItsEdgeIsOutnumbered) {
  EdgeFilter filter(Clock::duration(0), false);
  filter.doubt();
  EXPECT_EQ(filter.confirm(true, at(1)), std::nullopt);
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(filter.in_doubt());
    EXPECT_EQ(filter.confirm(false, at(2 + i)), std::nullopt);
  }
  EXPECT_FALSE(filter.in_doubt());
  EXPECT_EQ(filter.lost(), 0U);
}

/// Reference for debouncing, from the whole wave at once: the levels that were kept for the period.
std::vector<EdgeEvent> kept_levels(const std::vector<EdgeEvent>& edges, Clock::duration period) {
  std::vector<EdgeEvent> kept;
  Edge last = Edge::Falling;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const bool is_kept = i + 1 == edges.size() || edges[i + 1].stamp - edges[i].stamp >= period;
    if (!is_kept || edges[i].edge == last) continue;
    kept.push_back(edges[i]);
    last = edges[i].edge;
  }
  return kept;
}

TEST(EdgeFilter, AgreesWithTheDefinitionOnRandomWaves) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    std::exponential_distribution<double> pause(1 / 2.0);
    Wire wire{milliseconds(2)};
    double when = 10;
    for (int i = 0; i < 101; ++i) wire.change(when += 0.001 + pause(random), i % 2 == 0);
    EXPECT_EQ(wire.run(when + 100), kept_levels(wire.edges, milliseconds(2))) << "seed " << seed;
    EXPECT_EQ(wire.filter.lost(), 0U);
  }
}

}  // namespace
}  // namespace orbwatch::hal
