// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "hal/mcap/completion.h"
#include "hal/mcap/reader.h"
#include "tests/hal/mcap/memory_file.h"
#include "tests/hal/mcap/recording.h"
#include "tests/support/reference_data.h"
#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

/// Recordings in the readers of others, which readers/install fetches.
namespace orbwatch::hal::mcap {
namespace {

using Lines = std::set<std::string>;

const std::filesystem::path kReaders =
    std::filesystem::path(ORBWATCH_SOURCE_DIR) / "build/mcap-readers";
const std::filesystem::path kScripts =
    std::filesystem::path(ORBWATCH_SOURCE_DIR) / "tests/hal/mcap/readers";

std::string hex(std::span<const std::byte> data) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (const std::byte byte : data) {
    text += kDigits[std::to_integer<unsigned>(byte) >> 4];
    text += kDigits[std::to_integer<unsigned>(byte) & 15];
  }
  return text;
}

/// Lines that a program prints.
Lines printed(std::vector<std::string> command, const tests::TemporaryFolder& folder) {
  tests::Subprocess program(std::move(command), folder / "printed");
  const int code = program.wait();
  std::istringstream output(program.output());
  EXPECT_EQ(code, 0) << output.str();
  Lines lines;
  for (std::string line; std::getline(output, line);) {
    if (!line.empty()) lines.insert(line);
  }
  return lines;
}

std::string text_of(const tests::RecordedMessage& message) {
  const MessageHead& head = message.head;
  return "message " + std::to_string(head.channel_id) + " " + std::to_string(head.sequence) + " " +
         std::to_string(head.log_time) + " " + std::to_string(head.publish_time) + " " +
         hex(message.data);
}

/// Lines that readers/read.mjs would print, from our own reader.
Lines lines_of(Reader& reader) {
  Lines lines;
  for (const auto& [id, schema] : reader.summary().schemas) {
    lines.insert("schema " + std::to_string(id) + " " + schema.name + " " + schema.encoding + " " +
                 hex(std::as_bytes(std::span(schema.data))));
  }
  for (const auto& [id, channel] : reader.summary().channels) {
    lines.insert("channel " + std::to_string(id) + " " + std::to_string(channel.schema_id) + " " +
                 channel.topic + " " + channel.message_encoding);
  }
  for (const auto& set : tests::sets_of(reader)) {
    for (const auto& message : set) lines.insert(text_of(message));
  }
  for (std::size_t k = 0; k < reader.summary().attachments.size(); ++k) {
    const auto attachment = reader.attachment(k);
    lines.insert("attachment " + attachment->name + " " + attachment->media_type + " " +
                 hex(attachment->data));
  }
  for (std::size_t k = 0; k < reader.summary().metadata.size(); ++k) {
    std::string entries;
    const auto metadata = reader.metadata(k);
    for (const auto& [key, value] : metadata->entries) {
      entries += entries.empty() ? "\"" : ",\"";
      entries += key;
      entries += "\":\"";
      entries += value;
      entries += "\"";
    }
    lines.insert("metadata " + metadata->name + " {" + entries + "}");
  }
  return lines;
}

class McapInJavaScript : public testing::Test {
 protected:
  void SetUp() override {
    ORBWATCH_REQUIRE_FILE(kReaders / "node_modules/@mcap/core");
    ORBWATCH_REQUIRE_FILE(kReaders / "node_modules/fzstd");
  }

  Lines read(const std::filesystem::path& file, const char* how) const {
    return printed({"/usr/bin/env", "NODE_PATH=" + (kReaders / "node_modules").string(), "node",
                    kScripts / "read.mjs", file, how},
                   folder_);
  }
  /// Both ways of reading agree with ours.
  void expect_finished(const std::filesystem::path& file) const {
    Reader reader = tests::opened(file);
    ASSERT_TRUE(reader.is_finished());
    Lines lines = lines_of(reader);
    EXPECT_EQ(read(file, "streamed"), lines);
    const Statistics statistics = reader.summary().statistics();
    lines.insert("statistics " + std::to_string(statistics.message_count) + " " +
                 std::to_string(statistics.chunk_count));
    EXPECT_EQ(read(file, "indexed"), lines);
  }

  tests::TemporaryFolder folder_;
};

TEST_F(McapInJavaScript, AFinishedFileHasTheSameContent) {
  for (const bool is_compressed : {true, false}) {
    const auto file = folder_ / (is_compressed ? "zstd.mcap" : "plain.mcap");
    tests::write_recording(file, tests::random_recording(1, 12, 2000),
                           {.is_compressed = is_compressed});
    expect_finished(file);
  }
}

TEST_F(McapInJavaScript, AnEmptyFileIsRead) {
  tests::write_recording(folder_ / "a.mcap", {});
  expect_finished(folder_ / "a.mcap");
}

TEST_F(McapInJavaScript, AnUnfinishedFileIsReadUpToTheTornRecordAndCompleted) {
  const auto file = folder_ / "a.mcap";
  tests::write_recording(file, tests::random_recording(2, 12, 2000));
  const Reader whole = tests::opened(file);
  const ChunkIndex torn = whole.summary().chunks[9];
  const std::uint64_t chunk_end = torn.offset + torn.length;
  for (const std::uint64_t size :
       {torn.offset, torn.offset + 5, torn.offset + torn.length / 2, chunk_end, chunk_end + 11}) {
    SCOPED_TRACE(size);
    std::filesystem::copy_file(file, folder_ / "cut.mcap",
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(folder_ / "cut.mcap", size);
    Reader reader = tests::opened(folder_ / "cut.mcap");
    EXPECT_EQ(read(folder_ / "cut.mcap", "streamed"), lines_of(reader));
    ASSERT_TRUE(complete(folder_ / "cut.mcap"));
    expect_finished(folder_ / "cut.mcap");
  }
}

/// metadata.yaml of rosbag2 for one recording in the same folder.
void write_bag_metadata(const std::filesystem::path& folder, const Summary& summary) {
  const Statistics statistics = summary.statistics();
  std::ofstream out(folder / "metadata.yaml");
  out << "rosbag2_bagfile_information:\n  version: 8\n  storage_identifier: mcap\n"
      << "  duration:\n    nanoseconds: "
      << statistics.message_end_time - statistics.message_start_time
      << "\n  starting_time:\n    nanoseconds_since_epoch: " << statistics.message_start_time
      << "\n  message_count: " << statistics.message_count << "\n  topics_with_message_count:\n";
  for (const auto& [id, channel] : summary.channels) {
    out << "    - topic_metadata:\n        name: " << channel.topic
        << "\n        type: " << summary.schemas.at(channel.schema_id).name
        << "\n        serialization_format: cdr\n        offered_qos_profiles: []\n"
        << "        type_description_hash: \"\"\n"
        << "      message_count: " << summary.message_counts.at(id) << "\n";
  }
  out << "  compression_format: \"\"\n  compression_mode: \"\"\n"
      << "  relative_file_paths:\n    - a.mcap\n  files: []\n"
      << "  custom_data: ~\n  ros_distro: jazzy\n";
}

Lines rosbags_lines(Reader& reader) {
  Lines lines;
  for (const auto& set : tests::sets_of(reader)) {
    for (const auto& message : set) {
      const Channel& channel = reader.summary().channels.at(message.head.channel_id);
      lines.insert(channel.topic + " " + reader.summary().schemas.at(channel.schema_id).name + " " +
                   std::to_string(message.head.log_time) + " " + hex(message.data));
    }
  }
  return lines;
}

TEST(McapInRosbags, FinishedAndCompletedFilesHaveTheSameMessages) {
  ORBWATCH_REQUIRE_FILE(kReaders / "trixie/usr/lib/python3/dist-packages/rosbags");
  const tests::TemporaryFolder folder;
  const auto file = folder / "a.mcap";
  auto recording = tests::random_recording(3, 12, 2000);
  for (auto& set : recording.sets) {
    for (auto& message : set) message.data.push_back(std::byte{0});  // CDR is never empty
  }
  tests::write_recording(file, recording);
  for (const bool is_completed : {false, true}) {
    SCOPED_TRACE(is_completed);
    if (is_completed) {
      const ChunkIndex torn = tests::opened(file).summary().chunks[9];
      std::filesystem::resize_file(file, torn.offset + torn.length + 11);
      ASSERT_TRUE(complete(file));
    }
    Reader reader = tests::opened(file);
    write_bag_metadata(folder.path(), reader.summary());
    EXPECT_EQ(printed({kScripts / "trixie_python", kScripts / "read.py", folder.path()}, folder),
              rosbags_lines(reader));
  }
}

}  // namespace
}  // namespace orbwatch::hal::mcap
