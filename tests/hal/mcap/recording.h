// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "hal/mcap/reader.h"
#include "hal/mcap/writer.h"

/// Recordings of frame sets with random content.
namespace orbwatch::tests {

/// A message that owns its data.
struct RecordedMessage {
  hal::mcap::MessageHead head;
  hal::mcap::Bytes data;

  bool operator==(const RecordedMessage&) const = default;
};

/// Messages between two flushes.
using RecordedSet = std::vector<RecordedMessage>;

/// Content of a recording.
struct Recording {
  std::vector<RecordedSet> sets;
  std::vector<hal::mcap::Attachment> attachments;  ///< one in front of each of the first sets
  std::vector<hal::mcap::Metadata> metadata;       ///< in front of all sets
};

/// `bytes` of random data, of which a half is easy to compress.
inline hal::mcap::Bytes random_bytes(std::mt19937& random, std::size_t bytes) {
  hal::mcap::Bytes data(bytes, std::byte{7});
  for (std::size_t k = 0; k < bytes / 2; ++k) data[k] = static_cast<std::byte>(random());
  return data;
}

inline std::size_t up_to(std::mt19937& random, std::size_t most) {
  return std::uniform_int_distribution<std::size_t>(0, most)(random);
}

/// One to `channels` messages of set `number`, of up to `most` bytes each.
inline RecordedSet random_set(std::mt19937& random, std::uint32_t number, std::uint16_t channels,
                              std::size_t most) {
  RecordedSet set;
  const std::size_t count = 1 + up_to(random, channels - 1U);
  for (std::size_t k = 0; k < count; ++k) {
    const auto channel = static_cast<std::uint16_t>(1 + up_to(random, channels - 1U));
    const std::uint64_t time = 1'700'000'000'000'000'000 + number * 1'000'000ULL + k;
    set.push_back({{channel, number, time + 5, time}, random_bytes(random, up_to(random, most))});
  }
  return set;
}

inline Recording random_recording(unsigned seed, std::uint32_t sets, std::size_t most) {
  std::mt19937 random(seed);
  Recording recording;
  for (std::uint32_t k = 0; k < sets; ++k) {
    recording.sets.push_back(random_set(random, k, 4, most));
  }
  for (const char* name : {"site.toml", "rig.toml", "recipes/weld.toml"}) {
    recording.attachments.push_back(
        {1'700'000'000'000'000'000, 0, name, "application/toml", random_bytes(random, 300)});
  }
  recording.metadata.push_back({"orbwatch", {{"serial", "42"}, {"place", "Cell 7, \xc3\x9f"}}});
  return recording;
}

/// Defines four channels of two schemas, with the ids 1 to 4.
inline void define_channels(hal::mcap::Writer& writer) {
  const auto image = writer.add_schema({0, "sensor_msgs/msg/Image", "ros2msg", "uint8[] data\n"});
  const auto text = writer.add_schema({0, "std_msgs/msg/String", "ros2msg", "string data\n"});
  ASSERT_TRUE(image && text);
  for (const char* topic : {"/north/image", "/south/image", "/south/rare"}) {
    ASSERT_TRUE(writer.add_channel({0, *image, topic, "cdr", {{"offered_qos_profiles", ""}}}));
  }
  ASSERT_TRUE(writer.add_channel({0, *text, "/state", "cdr", {}}));
}

inline void write_set(hal::mcap::Writer& writer, const RecordedSet& set) {
  for (const RecordedMessage& message : set) {
    const auto written = writer.write(message.head, message.data);
    ASSERT_TRUE(written) << written.error().message;
  }
}

/// Writes all but the end of the file.
inline void write_content(hal::mcap::Writer& writer, const Recording& recording) {
  define_channels(writer);
  for (const auto& metadata : recording.metadata) ASSERT_TRUE(writer.add_metadata(metadata));
  for (std::size_t k = 0; k < recording.sets.size(); ++k) {
    if (k < recording.attachments.size()) {
      ASSERT_TRUE(writer.attach(recording.attachments[k]));
    }
    write_set(writer, recording.sets[k]);
    ASSERT_TRUE(writer.flush());
  }
}

/// Writes a finished file.
inline void write_recording(const std::filesystem::path& path, const Recording& recording,
                            const hal::mcap::WriterSettings& settings = {}) {
  auto writer = hal::mcap::Writer::create(path, settings);
  ASSERT_TRUE(writer) << writer.error().message;
  write_content(*writer, recording);
  const auto finished = writer->finish();
  ASSERT_TRUE(finished) << finished.error().message;
}

/// All messages, set by set.
inline std::vector<RecordedSet> sets_of(hal::mcap::Reader& reader) {
  std::vector<RecordedSet> sets;
  for (std::size_t k = 0; k < reader.summary().chunks.size(); ++k) {
    const auto loaded = reader.load_chunk(k);
    EXPECT_TRUE(loaded) << loaded.error().message;
    RecordedSet& set = sets.emplace_back();
    while (const auto message = reader.next()) {
      set.push_back({message->head, {message->data.begin(), message->data.end()}});
    }
  }
  return sets;
}

inline hal::mcap::Reader opened(const std::filesystem::path& path) {
  auto reader = hal::mcap::Reader::open(path);
  if (!reader) throw std::runtime_error(reader.error().message);
  return std::move(*reader);
}

}  // namespace orbwatch::tests
