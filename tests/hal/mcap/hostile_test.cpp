// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>

#include "hal/mcap/completion.h"
#include "hal/mcap/crc32.h"
#include "hal/mcap/reader.h"
#include "tests/hal/mcap/memory_file.h"
#include "tests/hal/mcap/recording.h"
#include "tests/support/temporary_folder.h"

/// Files that are made to harm their reader. Each is refused in one sentence with a byte offset.
namespace orbwatch::hal::mcap {
namespace {

constexpr std::size_t kBegin = 8 + 9 + 4 + 4 + 4 + 8;  ///< magic and Header{}

template <class Record>
Bytes record(const Record& content) {
  Bytes bytes;
  append_record(bytes, content);
  return bytes;
}

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Bytes begin() { return Bytes(kMagic.begin(), kMagic.end()) + record(Header{}); }

Bytes definitions() {
  return record(Schema{1, "std_msgs/msg/String", "ros2msg", "string data"}) +
         record(Channel{1, 1, "/a", "cdr", {}});
}

Bytes message(std::uint16_t channel) { return record(MessageHead{channel, 0, 5, 5}); }

/// A chunk of records that says `said` of its size, if given.
Bytes chunk(const Bytes& records, const std::string& compression = "",
            std::optional<std::uint64_t> said = {}) {
  Bytes stored = records;
  if (compression == kZstd) {
    ZstdEncoder encoder(1);
    const auto encoded = *encoder.encode(records);
    stored.assign(encoded.begin(), encoded.end());
  }
  const ChunkHead head{
      5, 5, said.value_or(records.size()), crc32_of(records), compression, stored.size()};
  Bytes bytes;
  append_record(bytes, head, stored.size());
  return bytes + stored;
}

/// A finished file of `data`, with the summary that `change` makes of the right one.
Bytes finished(const Bytes& data, const std::function<void(Summary&)>& change) {
  Summary summary;
  EXPECT_TRUE(summary.add(Schema{1, "std_msgs/msg/String", "ros2msg", "string data"}, 0));
  EXPECT_TRUE(summary.add(Channel{1, 1, "/a", "cdr", {}}, 0));
  change(summary);
  Bytes bytes = begin() + data;
  append_end(bytes, summary, bytes.size(), 0);
  return bytes;
}

/// Index of the first chunk of a file.
ChunkIndex index_of(const Bytes& chunk) {
  return {5, 5, kBegin, chunk.size(), {}, 0, "", chunk.size(), 100};
}

void expect_one_sentence(const FileError& error, const std::string& part) {
  EXPECT_EQ(error.number, 0);
  EXPECT_NE(error.message.find(part), std::string::npos) << error.message;
  EXPECT_EQ(error.message.find('\n'), std::string::npos) << error.message;
}

/// The file is refused, and completing it changes nothing.
void expect_refused(const Bytes& bytes, const std::string& part) {
  SCOPED_TRACE(part);
  const tests::MemoryFile file;
  file.set(bytes);
  const auto reader = Reader::open(file.path());
  ASSERT_FALSE(reader);
  expect_one_sentence(reader.error(), part);
  const auto completion = complete(file.path());
  ASSERT_FALSE(completion);
  EXPECT_EQ(tests::bytes_of(file.path()), bytes);
}

/// The file is opened, and its first chunk refused.
void expect_chunk_refused(const Bytes& bytes, const std::string& part) {
  SCOPED_TRACE(part);
  const tests::MemoryFile file;
  file.set(bytes);
  Reader reader = tests::opened(file.path());
  const auto loaded = reader.load_chunk(0);
  ASSERT_FALSE(loaded);
  expect_one_sentence(loaded.error(), part);
  EXPECT_FALSE(reader.next());
}

TEST(McapHostile, OtherFilesAreRefused) {
  const std::string text = "A text that is longer than the magic.";
  const auto bytes = std::as_bytes(std::span(text));
  expect_refused({bytes.begin(), bytes.end()}, "byte 0: not an MCAP file");
  expect_refused(Bytes(kMagic.begin(), kMagic.end()) + definitions(), "schema at byte 8: it must");
}

TEST(McapHostile, SizesBeyondTheLimitsAreRefusedBeforeMemoryIsAllocated) {
  constexpr std::uint64_t kHuge = std::uint64_t{1} << 40;
  expect_refused(begin() + chunk({}, kZstd, kHuge), "1099511627776 bytes uncompressed; at most");
  const Bytes data = chunk(definitions() + message(1));
  expect_refused(finished(data,
                          [&](Summary& summary) {
                            summary.chunks.push_back(index_of(data));
                            summary.chunks[0].uncompressed_size = kHuge;
                          }),
                 "a chunk of 1099511627776 bytes; at most");
}

TEST(McapHostile, ABombIsRefusedByItsOwnSize) {
  const Bytes bomb(40 * kMebibyte);
  const Bytes data = chunk(bomb, kZstd, 1000);
  expect_chunk_refused(
      finished(data, [&](Summary& summary) { summary.chunks.push_back(index_of(data)); }),
      "zstd data of 41943040 bytes in a chunk of 1000 bytes");
}

TEST(McapHostile, IndexesOverEachOtherOrOutsideAreRefused) {
  const Bytes data = chunk(definitions() + message(1));
  const auto with = [&](const std::function<void(Summary&)>& change) {
    return finished(data, [&](Summary& summary) {
      summary.chunks.push_back(index_of(data));
      change(summary);
    });
  };
  expect_refused(with([&](Summary& s) { s.chunks.push_back(index_of(data)); }),
                 "the summary lists a chunk at byte " + std::to_string(kBegin));
  expect_refused(with([](Summary& s) { s.chunks[0].offset = UINT64_MAX; }),
                 "chunk at byte 18446744073709551615");
  expect_refused(with([](Summary& s) { s.chunks[0].length = 0; }), "0 bytes long; it must lie");
  expect_refused(with([](Summary& s) {
                   s.metadata.push_back({kBegin + 3, 20, "a"});
                 }),
                 "metadata at byte " + std::to_string(kBegin + 3));
  expect_refused(with([](Summary& s) {
                   s.chunks[0].message_index_offsets = {{1, 3}};
                   s.chunks[0].message_index_length = 40;
                 }),
                 "a message index at byte 3; it must be behind its chunk");
  expect_refused(with([](Summary& s) {
                   s.chunks[0].message_index_offsets = {{9, 3}};
                 }),
                 "channel 9 is unknown");
}

TEST(McapHostile, AnIndexOfAnotherRecordIsRefused) {
  const Bytes data = chunk(definitions() + message(1)) + record(Metadata{"a", {}});
  const auto bytes = finished(data, [&](Summary& summary) {
    summary.chunks.push_back(index_of(data));
    summary.chunks[0].offset += 1;
    summary.chunks[0].length -= 1;
  });
  expect_chunk_refused(bytes, "listed by the summary, but not there");
}

TEST(McapHostile, NamesThatLeaveTheirFolderAreRefused) {
  for (const char* name : {"../secret", "/etc/passwd", "recipes/../../a", "a\nb", ""}) {
    Bytes data;
    append_attachment(data, {0, 0, name, "text/plain", Bytes(3)});
    expect_refused(begin() + data, "attachment at byte " + std::to_string(kBegin) + ": ");
    expect_refused(
        finished(
            data,
            [&](Summary& summary) {
              summary.attachments.push_back({kBegin, data.size(), 0, 0, 3, name, "text/plain"});
            }),
        "attachment index at byte ");
  }
}

TEST(McapHostile, DefinitionsThatContradictAreRefused) {
  const auto schema = [](std::uint16_t id) { return record(Schema{id, "a/msg/B", "ros2msg", ""}); };
  expect_refused(begin() + schema(0), "id 0; ids of schemas begin at 1");
  expect_refused(begin() + definitions() + schema(1), "id 1 was defined differently before");
  expect_refused(begin() + record(Channel{1, 1, "/a", "cdr", {}}), "schema 1 is unknown");
  expect_refused(begin() + definitions() + message(1), "messages must be in chunks");
  expect_refused(begin() + chunk(definitions() + message(2)),
                 "channel 2 is unknown of the chunk at byte " + std::to_string(kBegin));
  expect_refused(begin() + record(Channel{1, 0, "/a\x1b[2J", "cdr", {}}), "control characters");
  expect_refused(begin() + record(Metadata{std::string(5000, 'a'), {}}), "a name of 5000 bytes");
  expect_refused(begin() + chunk(definitions() + message(1), "lz4"), "unknown compression");
}

TEST(McapHostile, FieldsBeyondTheirRecordsAreRefused) {
  Bytes schema = record(Schema{1, "a/msg/B", "ros2msg", "text"});
  schema[kRecordHead + 2] = std::byte{200};  // length of the name
  expect_refused(begin() + schema,
                 "schema at byte " + std::to_string(kBegin) + ": a field ends beyond the record");
  Channel channel{1, 0, "/a", "cdr", StringMap(65, {"", ""})};
  expect_refused(begin() + record(channel), "a map has more than 64 entries");
  Bytes inner = definitions() + message(1);
  inner[definitions().size() + 1] = std::byte{255};  // length of the message
  expect_refused(begin() + chunk(inner), "255 bytes long, but 22 bytes are left");
}

TEST(McapHostile, ADamagedFooterIsRefused) {
  const Bytes good = finished(chunk(definitions() + message(1)), [](Summary&) {});
  for (const std::size_t field : {0, 8}) {
    Bytes bytes = good;
    bytes[bytes.size() - 8 - 20 + field + 7] = std::byte{1};
    expect_refused(bytes, "they must lie in this order");
  }
}

TEST(McapHostile, ADamagedChunkOrAttachmentIsRefused) {
  tests::Recording recording = tests::random_recording(1, 3, 400);
  const tests::MemoryFile file;
  const tests::TemporaryFolder folder;
  tests::write_recording(folder / "a.mcap", recording);
  const Bytes good = tests::bytes_of(folder / "a.mcap");
  const Reader whole = tests::opened(folder / "a.mcap");
  const ChunkIndex& index = whole.summary().chunks[1];
  Bytes bytes = good;
  bytes[index.offset + index.length - 30] ^= std::byte{16};
  bytes[whole.summary().attachments[2].offset + 80] ^= std::byte{1};
  file.set(bytes);
  Reader reader = tests::opened(file.path());
  EXPECT_TRUE(reader.load_chunk(0));
  EXPECT_FALSE(reader.load_chunk(1));
  EXPECT_TRUE(reader.load_chunk(2));
  EXPECT_TRUE(reader.attachment(1));
  expect_one_sentence(reader.attachment(2).error(), ": its CRC is ");
}

}  // namespace
}  // namespace orbwatch::hal::mcap
