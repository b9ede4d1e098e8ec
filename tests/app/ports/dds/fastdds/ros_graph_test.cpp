// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/ports/dds/dds_sink.h"
#include "tests/app/ports/dds/dds_network.h"
#include "tests/app/ports/dds/fastdds/paced_views.h"
#include "tests/app/ports/dds/fastdds/reader_program.h"
#include "tests/app/ports/dds/fastdds/shipped_network.h"

/// Announcements for ROS 2's graph, received by another vendor's reader.
namespace orbwatch::app::dds {
namespace {

using orbwatch::tests::foreign_reader;
using orbwatch::tests::parsed;
using orbwatch::tests::ReaderProgram;
using tests::ShippedNetwork;

struct Generation {
  RosGeneration ros;
  const char* type;     ///< type argument of fastdds_reader
  std::size_t padding;  ///< digits after those of a GUID
};

class RosGraph : public testing::TestWithParam<Generation> {};

TEST_P(RosGraph, ShowsANodeWithTheWritersThatAreThere) {
  ORBWATCH_REQUIRE_NETWORK_NAMESPACES();
  const ShippedNetwork network(ShippedNetwork::Kind::Lan);
  DdsSink sink({.domain = tests::kDomain, .ros = GetParam().ros}, tests::make_names(), nullptr);
  network.start(sink);

  ReaderProgram graph(
      network.readers(),
      foreign_reader(tests::kDomain, {"--topic", "ros_discovery_info", "--type", GetParam().type,
                                      "--count", "1", "--transient-local"}));
  ASSERT_EQ(graph.program().wait(), 0) << graph.printed();
  ASSERT_EQ(graph.samples().size(), 1U) << graph.printed();
  const auto info = parsed(graph.samples().front());
  ASSERT_EQ(info["nodes"].size(), 1U) << graph.printed();
  const auto node = info["nodes"][0];
  EXPECT_EQ(node["name"].string(), "orbwatch");
  EXPECT_EQ(node["namespace"].string(), "/");

  ReaderProgram pictures(network.readers(),
                         foreign_reader(tests::kDomain, {"--topic", "rt/orbwatch/front/image_raw",
                                                         "--type", "image"}));
  ASSERT_TRUE(tests::eventually([&] { return pictures.match().has_value(); }));
  const std::string guid = parsed(*pictures.match())["guid"].string();
  ASSERT_EQ(guid.size(), 32U) << guid;
  std::vector<std::string> writers;
  for (const auto& writer : node["writers"]) writers.push_back(writer.string());
  EXPECT_THAT(writers, testing::Contains(guid + std::string(GetParam().padding, '0')));
  EXPECT_EQ(info["gid"].string().substr(0, 24), guid.substr(0, 24)) << "one participant";
}

INSTANTIATE_TEST_SUITE_P(Generations, RosGraph,
                         testing::Values(Generation{RosGeneration::Humble, "humble_discovery", 16},
                                         Generation{RosGeneration::Iron, "discovery", 0}),
                         [](const auto& generation) {
                           return generation.param.ros == RosGeneration::Humble ? "Humble" : "Iron";
                         });

}  // namespace
}  // namespace orbwatch::app::dds
