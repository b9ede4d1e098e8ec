// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/participant/participant.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <vector>

#include "app/ports/dds/dds_sink.h"
#include "app/ports/dds/pictures/image_message.h"
#include "app/ports/dds/topics/topic_reader.h"
#include "tests/app/ports/dds/dds_network.h"
#include "tests/app/ports/dds/participant/bound_socket.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::dds {
namespace {

constexpr int kDomain = 3;

void configure(const std::string& interface, const std::string& more = "") {
  const std::string uri = "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"" +
                          interface + "\"/></Interfaces><AllowMulticast>false</AllowMulticast>" +
                          "</General>" + more + "</Domain></CycloneDDS>";
  ASSERT_EQ(setenv("CYCLONEDDS_URI", uri.c_str(), 1), 0);
}

bool exists(dds_entity_t participant) {
  dds_guid_t guid{};
  return dds_get_guid(participant, &guid) == DDS_RETCODE_OK;
}

TEST(ParticipantTest, DomainsOutOfRangeAreNamed) {
  EXPECT_EQ(Participant::join(231).error().message, "DDS domain 231: out of range, 0 to 230");
  EXPECT_EQ(Participant::join(-1).error().message, "DDS domain -1: out of range, 0 to 230");
}

TEST(ParticipantTest, ThoseOfADomainComeAndGoByThemselves) {
  configure("lo");
  auto first = Participant::join(kDomain);
  auto second = Participant::join(kDomain);
  ASSERT_TRUE(first && second);
  const dds_entity_t handle = first->entity().get();
  EXPECT_TRUE(exists(handle));
  first->leave();
  EXPECT_FALSE(exists(handle));
  EXPECT_TRUE(exists(second->entity().get())) << "the other one stays";
  *first = std::move(*Participant::join(kDomain));
  EXPECT_TRUE(exists(first->entity().get()));
}

TEST(ParticipantTest, TheLastToLeaveClosesTheDomain) {
  configure("lo");
  auto participant = Participant::join(kDomain);
  ASSERT_TRUE(participant) << participant.error().message;
  // Only a newly created domain detects an unusable configuration.
  configure("absent0");
  EXPECT_TRUE(Participant::join(kDomain));
  participant->leave();
  EXPECT_FALSE(Participant::join(kDomain));
}

TEST(ParticipantTest, ItsAddressesAreThoseOfItsOwnSockets) {
  configure("lo");
  const auto camera = tests::bound_socket(SOCK_DGRAM, "127.0.0.77");
  auto first = Participant::join(kDomain);
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_THAT(first->addresses(), testing::ElementsAre("127.0.0.1"));
  const auto second = Participant::join(kDomain);
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_EQ(second->addresses(), first->addresses()) << "they share the sockets";
  first->leave();
  EXPECT_THAT(first->addresses(), testing::IsEmpty());
}

TEST(ParticipantTest, TheEnvironmentOverridesOurDefaults) {
  configure("lo", "<Internal><SocketReceiveBufferSize min=\"1MB\" max=\"2MB\"/></Internal>");
  const auto participant = Participant::join(kDomain);
  EXPECT_TRUE(participant) << participant.error().message;
  // More than any system grants: refused only if the minimum is enforced.
  configure("lo", "<Internal><SocketReceiveBufferSize min=\"2GB\" max=\"2GB\"/></Internal>");
  EXPECT_FALSE(Participant::join(kDomain + 1));
}

TEST(ParticipantTest, AProfileStandsForTheEnvironment) {
  const orbwatch::tests::TemporaryFolder folder;
  const auto profile = folder / "lo.xml";
  std::ofstream(profile) << "<CycloneDDS><Domain><General><Interfaces><NetworkInterface "
                            "name=\"lo\"/></Interfaces></General></Domain></CycloneDDS>";
  configure("absent0");
  EXPECT_FALSE(Participant::join(kDomain));
  const auto participant = Participant::join(kDomain, std::nullopt, {}, profile);
  EXPECT_TRUE(participant) << participant.error().message;
}

TEST(ParticipantTest, SamplesThatFillTheMemoryAreDropped) {
  configure("lo");
  const auto participant = Participant::join(kDomain);
  ASSERT_TRUE(participant) << participant.error().message;
  const auto topic =
      make_topic(participant->entity(), sensor_msgs_msg_dds__CompressedImage__desc, "rt/large");
  const auto writer = make_writer(participant->entity(), *topic, frame_qos());
  const auto reader = make_reader(participant->entity(), *topic, frame_qos());
  ASSERT_TRUE(topic && writer && reader);
  const auto arrives = [&](std::size_t size) {
    std::vector<std::uint8_t> data(size);
    char none = 0;
    CompressedImageMessage message{};
    message.header.frame_id = &none;
    message.format = &none;
    const auto length = static_cast<std::uint32_t>(size);
    message.data = {length, length, data.data(), false};
    dds_write(writer->get(), &message);
    int count = 0;
    EXPECT_TRUE(take_samples(reader->get(), [&](const void*, const auto&) { ++count; }));
    return count == 1;
  };
  EXPECT_TRUE(arrives(kMaxSampleBytes - 4096));
  EXPECT_FALSE(arrives(kMaxSampleBytes));
}

TEST(ParticipantTest, AProfileWhosePathCannotBeToldIsNamed) {
  const auto participant = Participant::join(kDomain, std::nullopt, {}, "/etc/a,b.xml");
  ASSERT_FALSE(participant);
  EXPECT_THAT(participant.error().message,
              testing::HasSubstr("/etc/a,b.xml: must not have a comma"));
}

TEST(ParticipantTest, AProfileThatIsMissingIsNamed) {
  configure("lo");
  EXPECT_EQ(Participant::join(kDomain, std::nullopt, {}, "/absent.xml").error().message,
            "DDS profile /absent.xml: no such file");
}

TEST(ParticipantTest, MissingInterfaceIsReportedInOneLine) {
  configure("absent0");
  const auto participant = Participant::join(kDomain);
  ASSERT_FALSE(participant);
  EXPECT_THAT(participant.error().message, testing::StartsWith("DDS domain 3: "));
  EXPECT_THAT(participant.error().message, testing::Not(testing::HasSubstr("\n")));
}

TEST(ParticipantTest, ASinkWaitsForAnInterfaceThatIsMissing) {
  configure("absent0");
  DdsSink sink({.domain = kDomain}, {{}, {"front"}, {}}, nullptr);
  ASSERT_TRUE(sink.start());
  EXPECT_EQ(sink.statistics().joins, 0u);

  configure("lo");
  EXPECT_TRUE(tests::eventually([&] {
    sink.accept(Status{});
    return sink.statistics().joins == 1;
  }));
}

TEST(ParticipantTest, ASinkStaysWhenTheInterfaceOfACameraGoes) {
  configure("lo");
  const auto camera = tests::bound_socket(SOCK_DGRAM, "127.0.0.77");
  // The sink watches every interface if it knows loopback addresses only, so another one is there.
  const NetworkAddress card{"eth1", "127.0.0.77"}, lo{"lo", "127.0.0.1"},
      other{"eth0", "192.168.0.7"};
  std::atomic<bool> is_unplugged = false;
  std::atomic<int> checks = 0;  // after the cable was pulled
  DdsSink sink({.domain = kDomain}, {{}, {"front"}, {}}, nullptr,
               [&]() -> std::optional<std::vector<NetworkAddress>> {
                 if (!is_unplugged) return std::vector{other, card, lo};
                 ++checks;
                 return std::vector{other, lo};
               });
  ASSERT_TRUE(sink.start());
  ASSERT_EQ(sink.statistics().joins, 1U);
  is_unplugged = true;
  // A second check begins when the consequences of the first have ended.
  ASSERT_TRUE(tests::eventually([&] {
    sink.accept(Status{});
    return checks >= 2;
  }));
  EXPECT_EQ(sink.statistics().joins, 1U);
}

}  // namespace
}  // namespace orbwatch::app::dds
