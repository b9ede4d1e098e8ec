// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/status/diagnostics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbwatch::app::dds {
namespace {

using testing::ElementsAre;
using testing::Pair;

TEST(NetworkDiagnostic, NamesEachReasonThatHasHappened) {
  DdsStatistics network;
  network.joins = 1;
  network.topics = {{.topic = "a", .written = 7, .replaced = 2}, {.topic = "b", .unread = 3}};
  const Diagnostic calm = diagnose_network(network);
  EXPECT_EQ(calm.level, DiagnosticLevel::Ok);
  EXPECT_THAT(calm.values, ElementsAre(Pair("joins", "1"), Pair("a written", "7"),
                                       Pair("a replaced", "2"), Pair("b unread", "3")));
}

TEST(NetworkDiagnostic, WarnsOfWhatWasRefusedOrGivenUp) {
  const auto warning = [](auto spoil) {
    DdsStatistics network;
    network.topics = {{.topic = "a", .last_error = "out of memory"}};
    spoil(network);
    const Diagnostic diagnostic = diagnose_network(network);
    EXPECT_EQ(diagnostic.level, DiagnosticLevel::Warn);
    EXPECT_EQ(diagnostic.values.size(), 1u);
    return diagnostic.message;
  };
  EXPECT_EQ(warning([](auto& n) { n.topics[0].failed = 1; }), "out of memory");
  EXPECT_EQ(warning([](auto& n) { n.topics[0].blocked = 1; }), "a reader does not keep up");
  EXPECT_EQ(warning([](auto& n) { n.dropped_events = 1; }), "events were lost");
  EXPECT_NE(warning([](auto& n) { n.mistyped = 1; }), warning([](auto& n) { n.malformed = 1; }));
}

}  // namespace
}  // namespace orbwatch::app::dds
