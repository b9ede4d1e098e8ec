// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "hal/mcap/completion.h"
#include "hal/mcap/reader.h"
#include "tests/hal/mcap/memory_file.h"
#include "tests/hal/mcap/recording.h"
#include "tests/support/share.h"
#include "tests/support/temporary_folder.h"

/// Power cuts: files that end anywhere.
namespace orbwatch::hal::mcap {
namespace {

/// A finished file, and what is complete when it is cut.
class CutRecording {
 public:
  CutRecording(unsigned seed, std::uint32_t sets, std::size_t most)
      : recording_(tests::random_recording(seed, sets, most)) {
    const tests::TemporaryFolder folder;
    tests::write_recording(folder / "whole.mcap", recording_);
    bytes_ = tests::bytes_of(folder / "whole.mcap");
    const Reader reader = tests::opened(folder / "whole.mcap");
    for (const ChunkIndex& chunk : reader.summary().chunks) {
      chunk_ends_.push_back(chunk.offset + chunk.length);
    }
    for (const AttachmentIndex& attachment : reader.summary().attachments) {
      attachment_ends_.push_back(attachment.offset + attachment.length);
    }
  }

  std::size_t size() const { return bytes_.size(); }
  /// Last byte of each chunk and attachment, and the first one behind.
  std::set<std::size_t> borders() const {
    std::set<std::size_t> places;
    for (const auto& ends : {chunk_ends_, attachment_ends_}) {
      for (const std::uint64_t end : ends) places.insert({end - 1, end, end + 1});
    }
    return places;
  }

  /// Cuts the file after `size` bytes: all complete sets are read, before and after its completion.
  void expect_kept(std::size_t size) const {
    SCOPED_TRACE("cut at byte " + std::to_string(size));
    file_.set(std::span(bytes_).first(size));
    expect_content(size, size == bytes_.size());
    const auto completion = complete(file_.path());
    ASSERT_TRUE(completion) << completion.error().message;
    EXPECT_EQ(completion->damaged, 0U);
    expect_content(size, true);
  }

 private:
  static std::size_t complete_parts(const std::vector<std::uint64_t>& ends, std::size_t size) {
    return static_cast<std::size_t>(
        std::ranges::count_if(ends, [size](std::uint64_t end) { return end <= size; }));
  }
  void expect_content(std::size_t size, bool is_finished) const {
    auto reader = Reader::open(file_.path());
    ASSERT_TRUE(reader) << reader.error().message;
    ASSERT_EQ(reader->is_finished(), is_finished);
    const auto sets = tests::sets_of(*reader);
    ASSERT_EQ(sets.size(), complete_parts(chunk_ends_, size));
    EXPECT_TRUE(std::equal(sets.begin(), sets.end(), recording_.sets.begin()));
    const std::size_t attachments = complete_parts(attachment_ends_, size);
    ASSERT_EQ(reader->summary().attachments.size(), attachments);
    for (std::size_t k = 0; k < attachments; ++k) {
      EXPECT_EQ(reader->attachment(k)->data, recording_.attachments[k].data);
    }
    if (!is_finished) return;
    for (const ChunkIndex& chunk : reader->summary().chunks) {
      EXPECT_FALSE(chunk.message_index_offsets.empty());
    }
  }

  tests::Recording recording_;
  Bytes bytes_;
  std::vector<std::uint64_t> chunk_ends_, attachment_ends_;
  tests::MemoryFile file_;
};

TEST(McapCut, AnywhereInTheLast64KiBKeepsAllCompleteSets) {
  constexpr std::size_t kLast = 64 << 10;
  const CutRecording cut(1, 40, 2600);
  ASSERT_GT(cut.size(), kLast);
  tests::DrawnShare share(static_cast<int>(kLast));
  for (std::size_t size = cut.size() - kLast; size < cut.size(); ++size) {
    if (share.next()) cut.expect_kept(size);
    if (HasFatalFailure()) return;
  }
  cut.expect_kept(cut.size());
}

TEST(McapCut, AtTheBordersOfRecordsKeepsAllCompleteSets) {
  const CutRecording cut(2, 20, 300);
  for (const std::size_t size : cut.borders()) cut.expect_kept(size);
}

TEST(McapCut, InItsFirstBytesLeavesAnEmptyRecording) {
  const CutRecording cut(3, 3, 100);
  for (std::size_t size = 0; size < 200; ++size) cut.expect_kept(size);
}

TEST(McapCut, AtRandomPlacesKeepsAllCompleteSets) {
  const CutRecording cut(4, 60, 40'000);
  std::mt19937 random(4);
  for (int k = tests::share_of(1000); k > 0; --k) cut.expect_kept(tests::up_to(random, cut.size()));
}

/// A power cut may leave the size of a file without its data.
TEST(McapCut, LeavingZerosIsDropped) {
  const tests::TemporaryFolder folder;
  const auto recording = tests::random_recording(6, 5, 500);
  {
    auto writer = Writer::create(folder / "a.mcap");
    ASSERT_TRUE(writer);
    tests::write_content(*writer, recording);
  }
  const Bytes bytes = tests::bytes_of(folder / "a.mcap");
  const Reader whole = tests::opened(folder / "a.mcap");
  const tests::MemoryFile file;
  for (const std::size_t lost : {0, 1, 7, 100, 2000}) {
    SCOPED_TRACE(lost);
    Bytes torn = bytes;
    std::fill(torn.end() - static_cast<std::ptrdiff_t>(lost), torn.end(), std::byte{0});
    torn.resize(bytes.size() + 5000);
    file.set(torn);
    const auto completion = complete(file.path());
    ASSERT_TRUE(completion) << completion.error().message;
    Reader reader = tests::opened(file.path());
    const auto sets = tests::sets_of(reader);
    const auto kept = std::ranges::count_if(whole.summary().chunks, [&](const ChunkIndex& chunk) {
      return chunk.offset + chunk.length <= bytes.size() - lost;
    });
    ASSERT_GE(std::ssize(sets), kept);
    EXPECT_TRUE(std::equal(sets.begin(), sets.end(), recording.sets.begin()));
  }
}

/// Offset of the summary that the footer of a finished file states.
std::uint64_t summary_of(const Bytes& bytes) {
  std::uint64_t offset = 0;
  const auto footer = std::span(bytes).last(kMagic.size() + kFooterSize - kRecordHead);
  FieldReader fields(footer);
  EXPECT_TRUE(fields(offset));
  return offset;
}

/// A power cut may leave the footer without the summary in front of it, or with a part of it.
TEST(McapCut, LeavingTheFooterIsCompletedFromTheRecords) {
  const tests::TemporaryFolder folder;
  const auto recording = tests::random_recording(8, 20, 500);
  tests::write_recording(folder / "whole.mcap", recording);
  const Bytes whole = tests::bytes_of(folder / "whole.mcap");
  const std::uint64_t summary = summary_of(whole), end = whole.size() - kMagic.size() - kFooterSize;
  ASSERT_GT(end, summary + 100);
  const tests::MemoryFile file;
  for (const std::uint64_t lost : {summary - kDataEndSize, summary, end - 100}) {
    SCOPED_TRACE(lost);
    Bytes torn = whole;
    std::fill(torn.begin() + static_cast<std::ptrdiff_t>(lost),
              torn.begin() + static_cast<std::ptrdiff_t>(end), std::byte{0});
    file.set(torn);
    {
      Reader reader = tests::opened(file.path());
      EXPECT_FALSE(reader.is_finished());
      EXPECT_EQ(tests::sets_of(reader), recording.sets);
    }
    const auto completion = complete(file.path());
    ASSERT_TRUE(completion) << completion.error().message;
    EXPECT_FALSE(completion->was_finished);
    Reader reader = tests::opened(file.path());
    EXPECT_TRUE(reader.is_finished());
    EXPECT_EQ(tests::sets_of(reader), recording.sets);
    EXPECT_EQ(reader.summary().attachments.size(), recording.attachments.size());
    EXPECT_EQ(reader.summary().metadata.size(), recording.metadata.size());
  }
}

/// A damaged chunk between good ones stays in the file, but is not listed.
TEST(Complete, SkipsADamagedChunk) {
  const tests::TemporaryFolder folder;
  const auto recording = tests::random_recording(7, 6, 500);
  tests::write_recording(folder / "whole.mcap", recording);
  const Reader whole = tests::opened(folder / "whole.mcap");
  const ChunkIndex& damaged = whole.summary().chunks[3];
  const std::uint64_t end = whole.summary().chunks[5].offset + whole.summary().chunks[5].length;
  Bytes bytes = tests::bytes_of(folder / "whole.mcap");
  bytes.resize(end);
  bytes[damaged.offset + damaged.length - 20] ^= std::byte{1};
  const tests::MemoryFile file;
  file.set(bytes);
  const auto completion = complete(file.path());
  ASSERT_TRUE(completion) << completion.error().message;
  EXPECT_EQ(completion->damaged, 1U);
  auto expected = recording.sets;
  expected.erase(expected.begin() + 3);
  Reader reader = tests::opened(file.path());
  EXPECT_EQ(tests::sets_of(reader), expected);
}

}  // namespace
}  // namespace orbwatch::hal::mcap
