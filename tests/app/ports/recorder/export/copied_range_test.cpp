// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/copied_range.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "tests/app/ports/recorder/export/recorded_event.h"

namespace orbwatch::app::recorder {
namespace {

using testing::HasSubstr;
using tests::ReadMessage;

using Messages = std::map<std::string, std::vector<ReadMessage>>;

class CopiedRange : public tests::RecordedEventTest {
 protected:
  std::filesystem::path copied(const ExportRange& range) const {
    std::filesystem::path file = folder / "copy.mcap";
    std::filesystem::remove(file);
    const auto done = copy_range(recording, stamps(range), file, go_on);
    EXPECT_TRUE(done) << done.error().message;
    return file;
  }

  /// Messages of the event with these stamps.
  Messages expected(const StampRange& range) const {
    Messages messages = tests::read_recording(recording);
    for (auto& entry : messages) {
      std::erase_if(entry.second,
                    [&](const ReadMessage& message) { return !range.has(message.log_time); });
    }
    std::erase_if(messages, [](const auto& entry) { return entry.second.empty(); });
    return messages;
  }

  static void expect_same(const Messages& copied, const Messages& expected) {
    ASSERT_EQ(copied.size(), expected.size());
    for (const auto& entry : expected) {
      SCOPED_TRACE(entry.first);
      ASSERT_TRUE(copied.contains(entry.first));
      const auto& found = copied.at(entry.first);
      ASSERT_EQ(found.size(), entry.second.size());
      for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_EQ(found[k].log_time, entry.second[k].log_time);
        EXPECT_EQ(found[k].sequence, entry.second[k].sequence);
        EXPECT_EQ(found[k].bytes, entry.second[k].bytes);
      }
    }
  }
};

TEST_F(CopiedRange, HasTheFirstAndTheLastFrameSetAndTheirBytes) {
  const ExportRange range = numbers(sets[2], sets[7]);
  Messages copy = tests::read_recording(copied(range));
  EXPECT_EQ(tests::frame_sets_of(copy["/orbwatch/process_state"]),
            std::vector<std::uint64_t>(sets.begin() + 2, sets.begin() + 8));
  EXPECT_EQ(copy["/orbwatch/thermal/image_raw"].size(), 6U);
  EXPECT_EQ(copy["/orbwatch/thermal/image_raw"].front().sequence, sets[2]);
  EXPECT_EQ(copy["/orbwatch/thermal/image_raw"].back().sequence, sets[7]);
  expect_same(copy, expected(stamps(range)));
}

TEST_F(CopiedRange, IsTheWholeEventWithoutARange) {
  expect_same(tests::read_recording(copied({})), tests::read_recording(recording));
}

TEST_F(CopiedRange, KeepsAttachmentsMetadataSchemasAndTimes) {
  const auto file = copied(numbers(sets[2], sets[7]));
  auto from = hal::mcap::Reader::open(recording);
  auto to = hal::mcap::Reader::open(file);
  ASSERT_TRUE(from && to);
  EXPECT_EQ(to->header().profile, from->header().profile);
  ASSERT_FALSE(from->summary().attachments.empty());
  ASSERT_EQ(to->summary().attachments.size(), from->summary().attachments.size());
  for (std::size_t k = 0; k < from->summary().attachments.size(); ++k) {
    const auto left = from->attachment(k), right = to->attachment(k);
    ASSERT_TRUE(left && right);
    EXPECT_EQ(right->name, left->name);
    EXPECT_EQ(right->media_type, left->media_type);
    EXPECT_EQ(right->log_time, left->log_time);
    EXPECT_EQ(right->data, left->data);
  }
  ASSERT_EQ(from->summary().metadata.size(), 2U) << "versions and clock";
  ASSERT_EQ(to->summary().metadata.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(to->metadata(k)->name, from->metadata(k)->name);
    EXPECT_EQ(to->metadata(k)->entries, from->metadata(k)->entries);
  }
  for (const auto& entry : to->summary().channels) {
    const hal::mcap::Channel& channel = entry.second;
    const auto& before = from->summary().channels;
    const auto same = std::ranges::find_if(
        before, [&](const auto& other) { return other.second.topic == channel.topic; });
    ASSERT_NE(same, before.end());
    EXPECT_EQ(channel.metadata, same->second.metadata);
    const auto& schema = to->summary().schemas.at(channel.schema_id);
    const auto& other = from->summary().schemas.at(same->second.schema_id);
    EXPECT_EQ(schema.name, other.name);
    EXPECT_EQ(schema.data, other.data);
  }
}

TEST_F(CopiedRange, MomentsBelongToTheRange) {
  const StampRange by_number = stamps(numbers(sets[3], sets[5]));
  const ExportRange moments{RangeEnd{true, by_number.first}, RangeEnd{true, by_number.last}};
  EXPECT_EQ(stamps(moments).sets, 3U);
  const ExportRange inside{RangeEnd{true, by_number.first + 1}, RangeEnd{true, by_number.last - 1}};
  EXPECT_EQ(stamps(inside).sets, 1U);
}

TEST_F(CopiedRange, NoFrameSetIsAnErrorThatNamesThoseThatThereAre) {
  const auto none = stamps_in(recording, numbers(1000, 2000));
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("it has " + std::to_string(sets.front()) + " ("));
  EXPECT_THAT(none.error().message, HasSubstr(" to " + std::to_string(sets.back()) + " ("));
  EXPECT_FALSE(stamps_in(recording, numbers(sets[5], sets[3])));
}

TEST_F(CopiedRange, DamageIsAnError) {
  damage();
  EXPECT_FALSE(stamps_in(recording, {}));
  const auto copied = copy_range(recording, {}, folder / "copy.mcap", go_on);
  ASSERT_FALSE(copied);
  EXPECT_THAT(copied.error().message, HasSubstr(recording.string()));
}

TEST_F(CopiedRange, IsCancelled) {
  const auto copied = copy_range(recording, {}, folder / "copy.mcap", cancel);
  ASSERT_FALSE(copied);
  EXPECT_THAT(copied.error().message, HasSubstr("cancelled"));
}

TEST(RangeEnds, AreNumbersOrUtc) {
  EXPECT_EQ(parse_range_end("17")->value, 17U);
  EXPECT_FALSE(parse_range_end("17")->is_moment);
  const auto moment = parse_range_end("1970-01-02T00:00:01.5Z");
  ASSERT_TRUE(moment);
  EXPECT_TRUE(moment->is_moment);
  EXPECT_EQ(moment->value, 86'401'500'000'000U);
  EXPECT_EQ(parse_range_end("2026-11-28T09:22:00.125000001Z")->value, 1'795'857'720'125'000'001U);
  EXPECT_EQ(parse_range_end("2024-02-29T00:00:00Z")->value, 1'709'164'800'000'000'000U);
  for (const char* const wrong :
       {"", "-1", "1.5", "17 ", "0x10", "99999999999999999999", "2026-11-28", "2026-11-28T09:22:00",
        "2026-13-28T09:22:00Z", "2026-02-30T09:22:00Z", "2026-11-28T25:22:00Z",
        "2026-11-28T09:22:60Z", "2026-11-28T09:22:00.Z", "2026-11-28T09:22:00.1234567890Z",
        "2026-11-28T09:22:00+01:00", "1969-12-31T23:59:59Z"}) {
    EXPECT_FALSE(parse_range_end(wrong)) << wrong;
  }
}

}  // namespace
}  // namespace orbwatch::app::recorder
