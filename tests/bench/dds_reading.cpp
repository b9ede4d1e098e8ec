// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/dds_reading.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include "app/cli/dds/subscription.h"
#include "app/ports/dds/participant/participant.h"
#include "app/ports/dds/pictures/image_message.h"
#include "app/ports/dds/topics/topic_names.h"

namespace orbwatch::bench {

namespace {

volatile std::sig_atomic_t ended = 0;

template <class Value>
Value checked(Result<Value> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

/// The path of this program, which reads pictures when started with the corresponding arguments.
std::string own_path() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

}  // namespace

int read_pictures(int domain, const std::string& topic_name) {
  std::signal(SIGTERM, [](int) { ended = 1; });
  const bool jpeg = app::cli::is_compressed_topic(topic_name);
  const auto participant = checked(app::dds::Participant::join(domain));
  const auto topic = checked(app::dds::make_topic(
      participant.entity(),
      jpeg ? sensor_msgs_msg_dds__CompressedImage__desc : sensor_msgs_msg_dds__Image__desc,
      topic_name));
  const auto reader =
      checked(app::dds::make_reader(participant.entity(), topic, app::dds::frame_qos()));
  const app::dds::Entity condition(dds_create_readcondition(reader.get(), DDS_ANY_STATE));
  const app::dds::Entity waitset(dds_create_waitset(participant.entity().get()));
  dds_waitset_attach(waitset.get(), condition.get(), 0);
  while (ended == 0) {
    if (dds_waitset_wait(waitset.get(), nullptr, 0, DDS_MSECS(20)) <= 0) continue;
    void* sample = nullptr;
    dds_sample_info_t info{};
    const auto count = dds_take(reader.get(), &sample, &info, 1, 1);
    if (count > 0 && info.valid_data) {
      std::printf("{\"since_match_ms\": 0, \"length\": %u}\n",
                  jpeg ? static_cast<const app::dds::CompressedImageMessage*>(sample)->data._length
                       : static_cast<const app::dds::ImageMessage*>(sample)->data._length);
      std::fflush(stdout);
    }
    if (count > 0) dds_return_loan(reader.get(), &sample, count);
  }
  return 0;
}

std::string name_of(Vendor vendor) { return vendor == Vendor::Ours ? "Cyclone DDS" : "Fast DDS"; }

Readers start_readers(const app::tests::ShippedNetwork& network, const std::string& topic,
                      Vendor vendor, int count) {
  using app::tests::kDomain;
  const auto command =
      vendor == Vendor::Ours
          ? std::vector<std::string>{own_path(), "--read", std::to_string(kDomain), topic}
          : orbwatch::tests::foreign_reader(
                kDomain, {"--topic", topic, "--type",
                          app::cli::is_compressed_topic(topic) ? "compressed_image" : "image",
                          "--receive-buffer", "16777216"});
  Readers readers;
  for (int i = 0; i < count; ++i) {
    readers.push_back(std::make_unique<orbwatch::tests::ReaderProgram>(network.readers(), command));
  }
  return readers;
}

std::uint64_t received(const orbwatch::tests::ReaderProgram& reader) {
  return reader.samples().size();
}

double newest_kilobytes(const orbwatch::tests::ReaderProgram& reader) {
  return static_cast<double>(orbwatch::tests::parsed(reader.samples().back())["length"]) * 1e-3;
}

std::vector<std::uint64_t> settled(const Readers& readers) {
  constexpr auto kQuiet = std::chrono::milliseconds(500);
  std::vector<std::uint64_t> before;
  std::vector<std::uint64_t> now;
  do {
    before = now;
    std::this_thread::sleep_for(kQuiet);
    now.clear();
    for (const auto& reader : readers) now.push_back(received(*reader));
  } while (now != before);
  return now;
}

}  // namespace orbwatch::bench
