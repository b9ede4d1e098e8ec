// SPDX-License-Identifier: Apache-2.0
/// A secured sink and various peers on one network. Each is a domain of this process, so that all
/// samples cross UDP. The absence of samples for a peer is checked after other peers on the same
/// network received some.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "app/cli/dds/command_client.h"
#include "app/cli/dds/received_state.h"
#include "app/cli/dds/subscription.h"
#include "app/ports/dds/dds_sink.h"
#include "app/ports/dds/fleet/appliance_message.h"
#include "app/ports/dds/pictures/camera_info.h"
#include "app/ports/dds/pictures/image_message.h"
#include "app/ports/dds/security/enclave.h"
#include "app/ports/dds/status/diagnostics.h"
#include "app/ports/dds/status/event_message.h"
#include "app/ports/dds/topics/topic_names.h"
#include "tests/app/hand_over.h"
#include "tests/app/ports/dds/foreign_writer.h"
#include "tests/app/ports/dds/security/openssl_program.h"
#include "tests/app/ports/dds/security/test_keystore.h"
#include "tests/app/ports/dds/test_status.h"
#include "tests/app/ports/dds/test_views.h"
#include "tests/app/ports/dds/topic_reader.h"

namespace orbwatch::app::dds {
namespace {

namespace fs = std::filesystem;
using cli::enclave_folder;
using cli::StateReader;
using testing::AllOf;
using testing::HasSubstr;
using tests::DdsNetwork;
using tests::eventually;
using tests::ForeignWriter;
using tests::keystore_request;
using tests::make_keystore;

using ImageReader = tests::TopicReader<ImageMessage>;

/// Computers besides the sink's and the reader's. Each has one participant at a time, because
/// Cyclone DDS 0.10.2 leaks decrypted data of a second secured one in a domain of a process.
constexpr int kSecondPeer = 3;
constexpr int kThirdPeer = 4;
/// Number of frames of one peer after which those of another one would have arrived, too.
constexpr int kMany = 20;

SecuritySettings keys_of(const fs::path& keystore, const std::string& name) {
  return {enclave_folder(keystore, name)};
}

std::string front_topic() { return image_topic("orbwatch", "front"); }

class SecureNetwork : public testing::Test {
 protected:
  SecureNetwork()
      : second_domain_(dds_create_domain(kSecondPeer, DdsNetwork::configuration().c_str())),
        third_domain_(dds_create_domain(kThirdPeer, DdsNetwork::configuration().c_str())),
        keystore_(make_keystore(keystore_request(folder_ / "keys"))) {}

  void SetUp() override {
    ASSERT_TRUE(network_.valid() && second_domain_ && third_domain_);
    const auto started = sink_.start();
    ASSERT_TRUE(started) << started.error().message;
  }

  SecuritySettings subscriber() const { return keys_of(keystore_, "subscriber"); }

  Result<CommandAnswer> send(const std::optional<SecuritySettings>& security,
                             int domain = DdsNetwork::kReaderDomain) {
    const std::atomic<bool> cancelled{false};
    return cli::send_command(
        {.domain = domain, .timeout = std::chrono::minutes(1), .security = security},
        {CommandCode::Start, {}}, cancelled);
  }

  /// Publishes views until `reader` has received kMany of them, and calls `see` meanwhile.
  void show_until_seen(const ImageReader& reader, const std::function<void()>& see) {
    int seen = 0;
    EXPECT_TRUE(eventually([&] {
      tests::hand_over(sink_, tests::make_view(0, "front", 3, 16, 12));
      see();
      reader.take([&](const ImageMessage& image) {
        EXPECT_STREQ(image.header.frame_id, "front");
        ++seen;
      });
      return seen >= kMany;
    }));
  }

  orbwatch::tests::TemporaryFolder folder_;
  DdsNetwork network_;
  Entity second_domain_;
  Entity third_domain_;
  fs::path keystore_;
  std::atomic<int> commands_{0};
  DdsSink sink_{
      {.domain = DdsNetwork::kSinkDomain, .security = keys_of(folder_ / "keys", "appliance")},
      {{}, {"front"}, {}},
      [this](const Command&) {
        ++commands_;
        return CommandResult::Done;
      }};
};

TEST_F(SecureNetwork, WhoHasKeysSeesFramesAndStateAndCommands) {
  const ImageReader frames(sensor_msgs_msg_dds__Image__desc, front_topic(), frame_qos(),
                           DdsNetwork::kReaderDomain, subscriber());
  const auto view = tests::make_view(0, "front", 3, 64, 48);
  bool seen = false;
  ASSERT_TRUE(eventually([&] {
    tests::hand_over(sink_, view);
    frames.take([&](const ImageMessage& image) {
      ASSERT_EQ(image.width * image.height, 64U * 48U);
      ASSERT_EQ(image.data._length, view->bytes.size());
      seen = std::equal(view->bytes.begin(), view->bytes.end(), image.data._buffer);
    });
    return seen;
  }));

  StateReader states("orbwatch");
  const auto opened = states.open(kSecondPeer, subscriber());
  ASSERT_TRUE(opened) << opened.error().message;
  sink_.accept(tests::make_status());
  const auto state = states.next(std::chrono::minutes(1), [](const cli::ReceivedState&) {});
  ASSERT_TRUE(state) << state.error().message;
  EXPECT_TRUE(*state);

  const auto answer = send(subscriber(), kThirdPeer);
  ASSERT_TRUE(answer) << answer.error().message;
  EXPECT_EQ(answer->result, CommandResult::Done);
  EXPECT_EQ(commands_, 1);
}

/// The type of a topic of the sink.
const dds_topic_descriptor_t& type_of(const std::string& topic) {
  if (topic == process_state_topic("orbwatch")) return orbwatch_msgs_msg_dds__ProcessState__desc;
  if (topic == event_topic("orbwatch")) return orbwatch_msgs_msg_dds__Event__desc;
  if (topic == command_result_topic("orbwatch")) {
    return orbwatch_msgs_msg_dds__CommandResult__desc;
  }
  if (topic == kApplianceTopic) return orbwatch_msgs_msg_dds__Appliance__desc;
  if (topic == kThumbnailTopic) return orbwatch_msgs_msg_dds__Thumbnail__desc;
  if (topic == kDiagnosticsTopic) return diagnostic_msgs_msg_dds__DiagnosticArray__desc;
  if (topic.ends_with("/camera_info")) return sensor_msgs_msg_dds__CameraInfo__desc;
  if (cli::is_compressed_topic(topic)) return sensor_msgs_msg_dds__CompressedImage__desc;
  return sensor_msgs_msg_dds__Image__desc;
}

TEST_F(SecureNetwork, ASubscriberMayReadEveryTopicOfTheSink) {
  const auto topics = sink_.statistics().topics;
  ASSERT_GE(topics.size(), 6U);
  const auto participant = Participant::join(DdsNetwork::kReaderDomain, subscriber());
  ASSERT_TRUE(participant) << participant.error().message;
  for (const TopicStatistics& topic : topics) {
    const auto made = make_topic(participant->entity(), type_of(topic.topic), topic.topic);
    ASSERT_TRUE(made) << made.error().message;
    const auto reader = make_reader(participant->entity(), *made, frame_qos());
    ASSERT_TRUE(reader) << topic.topic << ": " << reader.error().message;
    EXPECT_TRUE(eventually([&] {
      dds_subscription_matched_status_t matched{};
      return dds_get_subscription_matched_status(reader->get(), &matched) == DDS_RETCODE_OK &&
             matched.current_count == 1;
    })) << topic.topic;
  }
}

TEST_F(SecureNetwork, WithoutKeysNothingIsSeenNorShown) {
  const ImageReader outsider(sensor_msgs_msg_dds__Image__desc, front_topic(), frame_qos(),
                             kSecondPeer);
  const ImageReader insider(sensor_msgs_msg_dds__Image__desc, front_topic(), frame_qos(),
                            DdsNetwork::kReaderDomain, subscriber());
  // Proves that the outsider receives from the network; its own samples must not reach the insider.
  const ForeignWriter plain(kThirdPeer, sensor_msgs_msg_dds__Image__desc, front_topic(),
                            frame_qos());
  ASSERT_TRUE(plain.wait_for_reader());
  std::string frame_id = "forged", encoding = "mono8";
  std::vector<std::uint8_t> pixel{1};
  ImageMessage image{};
  image.width = image.height = image.step = 1;
  image.header.frame_id = frame_id.data();
  image.encoding = encoding.data();
  image.data = {1, 1, pixel.data(), false};
  int forged = 0;
  show_until_seen(insider, [&] {
    plain.write(&image);
    outsider.take([&](const ImageMessage& seen) {
      EXPECT_STREQ(seen.header.frame_id, "forged");
      ++forged;
    });
  });
  EXPECT_GT(forged, 0);
  dds_subscription_matched_status_t matched{};
  ASSERT_EQ(dds_get_subscription_matched_status(outsider.get(), &matched), DDS_RETCODE_OK);
  EXPECT_EQ(matched.total_count, 1U) << "the plain writer only";
}

TEST_F(SecureNetwork, WithoutKeysNothingIsCommanded) {
  const ForeignWriter outsider(kSecondPeer, orbwatch_msgs_msg_dds__Command__desc,
                               command_topic("orbwatch"), command_qos());
  const tests::TopicReader<CommandMessage> plain(
      orbwatch_msgs_msg_dds__Command__desc, command_topic("orbwatch"), command_qos(), kThirdPeer);
  ASSERT_TRUE(outsider.wait_for_reader());
  std::string name = "start";
  std::uint64_t number = 0;
  int heard = 0;
  ASSERT_TRUE(eventually([&] {
    const CommandMessage request{99, ++number, name.data(), {0, 0, nullptr, false}};
    outsider.write(&request);
    plain.take([&](const CommandMessage&) { ++heard; });
    return heard >= kMany;
  })) << "it can be heard";
  const auto answer = send(subscriber());
  ASSERT_TRUE(answer) << answer.error().message;
  EXPECT_EQ(commands_, 1) << "that of the insider";
  EXPECT_EQ(sink_.statistics().commands.done, 1U);
}

TEST_F(SecureNetwork, AReaderMayNotCommand) {
  auto request = keystore_request(keystore_);
  request.subscribers = {"visitor"};
  request.subscriber = cli::reader_access("orbwatch");
  make_keystore(request);
  const auto refused = send(keys_of(keystore_, "visitor"), kSecondPeer);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("rt/orbwatch/command"));
  EXPECT_THAT(refused.error().message, HasSubstr("Not Allowed By Security"));
  const ImageReader visitor(sensor_msgs_msg_dds__Image__desc, front_topic(), frame_qos(),
                            kSecondPeer, keys_of(keystore_, "visitor"));
  show_until_seen(visitor, [] {});
  EXPECT_EQ(commands_, 0);
}

TEST_F(SecureNetwork, PermissionsThatSomebodyGaveHimselfAreVoid) {
  auto request = keystore_request(keystore_);
  request.subscribers = {"visitor"};
  request.subscriber = cli::reader_access("orbwatch");
  make_keystore(request);
  // The visitor's certificate is valid; authority and permissions come from the visitor's own
  // keystore, in which a visitor may command. The visitor's own computer accepts them.
  request.folder = folder_ / "forged";
  request.subscriber = cli::controller_access("orbwatch");
  make_keystore(request);
  const EnclaveFiles his(enclave_folder(keystore_, "visitor"));
  const EnclaveFiles forged(enclave_folder(folder_ / "forged", "visitor"));
  for (const auto member :
       {&EnclaveFiles::permissions_ca, &EnclaveFiles::governance, &EnclaveFiles::permissions}) {
    fs::copy_file(forged.*member, his.*member, fs::copy_options::overwrite_existing);
  }
  const ForeignWriter visitor(kSecondPeer, orbwatch_msgs_msg_dds__Command__desc,
                              command_topic("orbwatch"), command_qos(),
                              keys_of(keystore_, "visitor"));
  std::string name = "start";
  std::uint64_t number = 0;
  const ImageReader insider(sensor_msgs_msg_dds__Image__desc, front_topic(), frame_qos(),
                            DdsNetwork::kReaderDomain, subscriber());
  show_until_seen(insider, [&] {
    const CommandMessage message{99, ++number, name.data(), {0, 0, nullptr, false}};
    visitor.write(&message);
  });
  const auto answer = send(subscriber(), kThirdPeer);
  ASSERT_TRUE(answer) << answer.error().message;
  EXPECT_EQ(commands_, 1) << "that of the insider";
}

TEST_F(SecureNetwork, KeysOfAnotherAuthorityAreWorthNothing) {
  const auto others = make_keystore(keystore_request(folder_ / "others"));
  const ImageReader stranger(sensor_msgs_msg_dds__Image__desc, front_topic(), frame_qos(),
                             kSecondPeer, keys_of(others, "subscriber"));
  // A peer from which the visitor does receive.
  const ForeignWriter friendly(kThirdPeer, sensor_msgs_msg_dds__Image__desc, front_topic(),
                               frame_qos(), keys_of(others, "appliance"));
  ASSERT_TRUE(friendly.wait_for_reader());
  const ImageReader insider(sensor_msgs_msg_dds__Image__desc, front_topic(), frame_qos(),
                            DdsNetwork::kReaderDomain, subscriber());
  show_until_seen(insider, [&] {
    stranger.take([](const ImageMessage& image) { ADD_FAILURE() << image.header.frame_id; });
  });
}

TEST_F(SecureNetwork, WithKeysOfAnEarlierVersionTheSinkDoesAllButTheFleet) {
  auto earlier = keystore_request(folder_ / "earlier");
  for (auto* topics : {&earlier.appliance.publish, &earlier.appliance.subscribe}) {
    std::erase(*topics, kApplianceTopic);
    std::erase(*topics, kThumbnailTopic);
  }
  make_keystore(earlier);
  DdsSink sink({.domain = kSecondPeer, .security = keys_of(folder_ / "earlier", "appliance")},
               {{}, {"front"}, {}}, nullptr);
  ASSERT_TRUE(sink.start());
  EXPECT_TRUE(sink.works());
  StateReader states("orbwatch");
  ASSERT_TRUE(states.open(kThirdPeer, keys_of(folder_ / "earlier", "subscriber")));
  sink.accept(tests::make_status());
  const auto state = states.next(std::chrono::minutes(1), [](const cli::ReceivedState&) {});
  ASSERT_TRUE(state) << state.error().message;
  EXPECT_TRUE(*state);
  EXPECT_EQ(sink.statistics().joins, 1U);
}

TEST_F(SecureNetwork, WithKeysOfAnEarlierVersionTheSinkDoesAllButStatesOfTheMachine) {
  auto earlier = keystore_request(folder_ / "earlier");
  std::erase(earlier.appliance.subscribe, machine_state_topic("orbwatch"));
  make_keystore(earlier);
  DdsSink sink({.domain = kSecondPeer, .security = keys_of(folder_ / "earlier", "appliance")},
               {{}, {"front"}, {}}, nullptr, network_addresses, std::make_shared<CommandRecord>(),
               hal::SharedThreads::alone(), {}, nullptr, {}, {},
               {MachineSource::Dds, [](const MachineState&) { return Result<>(); }});
  testing::internal::CaptureStderr();
  ASSERT_TRUE(sink.start());
  EXPECT_TRUE(sink.works());
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              AllOf(HasSubstr("do not permit machine_state"), HasSubstr("orbwatch dds-keys")));
  EXPECT_EQ(sink.statistics().joins, 1U);
}

TEST_F(SecureNetwork, AppliancesAndReadersHearEachOther) {
  const auto fleet = std::make_shared<Fleet>();
  const auto participant = Participant::join(DdsNetwork::kReaderDomain, subscriber());
  ASSERT_TRUE(participant) << participant.error().message;
  FleetReader reader(*fleet);
  ASSERT_TRUE(reader.open(participant->entity()));
  DdsSink other({.domain = kSecondPeer, .security = keys_of(keystore_, "appliance")},
                {{}, {"front"}, {}}, nullptr, network_addresses, std::make_shared<CommandRecord>(),
                hal::SharedThreads::alone(), {"other", "", "orbwatch", {}},
                std::make_shared<Fleet>());
  ASSERT_TRUE(other.start());
  EXPECT_TRUE(eventually([&] {
    sink_.accept(tests::make_status());
    other.accept(tests::make_status());
    return fleet->list(hal::Clock::now()).size() == 2;
  }));
}

TEST_F(SecureNetwork, TheSinkDoesNotStartWithoutItsKeys) {
  DdsSink sink({.domain = kSecondPeer, .security = keys_of(folder_ / "absent", "appliance")},
               {{}, {"front"}, {}}, nullptr);
  const auto started = sink.start();
  ASSERT_FALSE(started);
  EXPECT_THAT(started.error().message,
              HasSubstr("absent/enclaves/appliance/identity_ca.cert.pem: cannot be read: No such"));
}

TEST(SecureParticipant, JoinsAgainAfterItLeft) {
  const orbwatch::tests::TemporaryFolder folder;
  const auto keystore = make_keystore(keystore_request(folder / "keys"));
  ASSERT_EQ(setenv("CYCLONEDDS_URI", DdsNetwork::configuration().c_str(), 1), 0);
  const Entity peer_domain(dds_create_domain(kSecondPeer, DdsNetwork::configuration().c_str()));
  const ImageReader peer(sensor_msgs_msg_dds__Image__desc, front_topic(), frame_qos(), kSecondPeer,
                         keys_of(keystore, "subscriber"));
  for (int time = 0; time < 3; ++time) {
    const ForeignWriter writer(DdsNetwork::kSinkDomain, sensor_msgs_msg_dds__Image__desc,
                               front_topic(), frame_qos(), keys_of(keystore, "appliance"));
    EXPECT_TRUE(writer.wait_for_reader());
  }
}

TEST(SecureParticipant, UsesNoSharedMemoryAlthoughItsProfileEnablesIt) {
  const orbwatch::tests::TemporaryFolder folder;
  const auto keystore = make_keystore(keystore_request(folder / "keys"));
  const auto profile = folder / "profile.xml", settings = folder / "settings.log";
  tests::write_text(profile,
                    DdsNetwork::configuration(
                        "<SharedMemory><Enable>true</Enable></SharedMemory><Tracing><Category>"
                        "config</Category><OutputFile>" +
                        settings.string() + "</OutputFile></Tracing>"));
  const auto participant =
      Participant::join(DdsNetwork::kSinkDomain, keys_of(keystore, "appliance"), {}, profile);
  ASSERT_TRUE(participant) << participant.error().message;
  EXPECT_THAT(tests::text_of_file(settings), HasSubstr("SharedMemory/Enable/#text: false"))
      << "as Cyclone DDS lists its settings";
}

/// Data on the wire while a sink publishes a view to a reader.
std::string wire_text(const std::optional<SecuritySettings>& appliance,
                      const std::optional<SecuritySettings>& subscriber, const fs::path& capture) {
  {
    const Entity sink_domain(dds_create_domain(
        DdsNetwork::kSinkDomain,
        DdsNetwork::configuration("<Tracing><PacketCaptureFile>" + capture.string() +
                                  "</PacketCaptureFile></Tracing>")
            .c_str()));
    const Entity reader_domain(
        dds_create_domain(DdsNetwork::kReaderDomain, DdsNetwork::configuration().c_str()));
    DdsSink sink({.domain = DdsNetwork::kSinkDomain, .security = appliance},
                 {{}, {"secret_place"}, {}}, nullptr);
    EXPECT_TRUE(sink.start());
    const ImageReader reader(sensor_msgs_msg_dds__Image__desc,
                             image_topic("orbwatch", "secret_place"), frame_qos(),
                             DdsNetwork::kReaderDomain, subscriber);
    bool seen = false;
    EXPECT_TRUE(eventually([&] {
      const auto view = tests::make_view(0, "secret_place", 3, 40, 1);
      std::ranges::copy(std::string_view("SECRET PIXELS"), view->bytes.begin());
      tests::hand_over(sink, view);
      reader.take([&](const ImageMessage&) { seen = true; });
      return seen;
    }));
  }
  return tests::text_of_file(capture);
}

TEST(SecureWire, ShowsNeitherPixelsNorNames) {
  const orbwatch::tests::TemporaryFolder folder;
  const auto keystore = make_keystore(keystore_request(folder / "keys"));
  const auto open = wire_text({}, {}, folder / "open.pcap");
  EXPECT_THAT(open, HasSubstr("SECRET PIXELS"));
  EXPECT_THAT(open, HasSubstr("secret_place"));
  const auto secured = wire_text(keys_of(keystore, "appliance"), keys_of(keystore, "subscriber"),
                                 folder / "secured.pcap");
  EXPECT_GT(secured.size(), 1000U);
  EXPECT_EQ(secured.find("SECRET PIXELS"), std::string::npos);
  EXPECT_EQ(secured.find("secret_place"), std::string::npos);
}

}  // namespace
}  // namespace orbwatch::app::dds
