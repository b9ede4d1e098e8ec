#include "app/dds/entity.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "app/dds/dds_sink.h"
#include "tests/app/dds/dds_network.h"

namespace orbwatch::app {
namespace {

TEST(EntityTest, IsDeletedWithItsOwnerAndMoves) {
  const tests::DdsNetwork network;
  ASSERT_TRUE(network.valid());
  dds_entity_t handle = 0;
  {
    Entity first = make_participant(tests::DdsNetwork::kSinkDomain).value();
    handle = first.get();
    Entity second = std::move(first);
    EXPECT_FALSE(first);
    EXPECT_EQ(second.get(), handle);
    dds_guid_t guid{};
    EXPECT_EQ(dds_get_guid(handle, &guid), DDS_RETCODE_OK);
  }
  dds_guid_t guid{};
  EXPECT_LT(dds_get_guid(handle, &guid), 0) << "the participant must be gone";
}

TEST(EntityTest, DomainsOutOfRangeAreNamed) {
  EXPECT_EQ(make_participant(231).error().message, "DDS domain 231: out of range, 0 to 230");
  EXPECT_EQ(make_participant(-1).error().message, "DDS domain -1: out of range, 0 to 230");
}

TEST(EntityTest, MissingInterfaceIsReportedInOneLine) {
  ASSERT_EQ(setenv("CYCLONEDDS_URI",
                   "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"absent0\"/>"
                   "</Interfaces></General></Domain></CycloneDDS>",
                   1),
            0);
  DdsSink sink({.domain = 3}, {"front"});
  const auto started = sink.start();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().message.rfind("DDS domain 3: ", 0), 0u) << started.error().message;
  EXPECT_EQ(started.error().message.find('\n'), std::string::npos);

  // The interface is back: the same sink can be started.
  ASSERT_EQ(setenv("CYCLONEDDS_URI",
                   "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\"/>"
                   "</Interfaces><AllowMulticast>false</AllowMulticast></General></Domain>"
                   "</CycloneDDS>",
                   1),
            0);
  const auto again = sink.start();
  EXPECT_TRUE(again) << again.error().message;
}

}  // namespace
}  // namespace orbwatch::app
