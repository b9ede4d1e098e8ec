// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <string>

#include "hal/mcap/completion.h"
#include "hal/mcap/reader.h"
#include "hal/mcap/writer.h"
#include "tests/hal/mcap/memory_file.h"
#include "tests/hal/mcap/recording.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::hal::mcap {
namespace {

void expect_attachments(Reader& reader, const std::vector<Attachment>& expected) {
  ASSERT_EQ(reader.summary().attachments.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const auto read = reader.attachment(k);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->name, expected[k].name);
    EXPECT_EQ(read->media_type, expected[k].media_type);
    EXPECT_EQ(read->log_time, expected[k].log_time);
    EXPECT_EQ(read->data, expected[k].data);
  }
}

class RoundTrip : public testing::TestWithParam<bool> {};

TEST_P(RoundTrip, KeepsEveryByteFinishedOrNot) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const tests::TemporaryFolder folder;
    const auto path = folder / "a.mcap";
    const auto recording = tests::random_recording(seed, 4 + seed, 3000);
    auto writer =
        Writer::create(path, {.header = {"ros2", "orbwatch test"}, .is_compressed = GetParam()});
    ASSERT_TRUE(writer) << writer.error().message;
    tests::write_content(*writer, recording);
    for (const bool is_finished : {false, true}) {
      if (is_finished) {
        ASSERT_TRUE(writer->finish());
      }
      Reader reader = tests::opened(path);
      EXPECT_EQ(reader.is_finished(), is_finished);
      EXPECT_EQ(reader.header().profile, "ros2");
      EXPECT_EQ(reader.header().writer, "orbwatch test");
      EXPECT_EQ(tests::sets_of(reader), recording.sets);
      expect_attachments(reader, recording.attachments);
      ASSERT_EQ(reader.summary().metadata.size(), 1U);
      EXPECT_EQ(*reader.metadata(0), recording.metadata[0]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Mcap, RoundTrip, testing::Bool(), [](const auto& info) {
  return info.param ? "Compressed" : "Uncompressed";
});

TEST(Mcap, DescribesWhatItHolds) {
  const tests::TemporaryFolder folder;
  const auto recording = tests::random_recording(1, 30, 100);
  tests::write_recording(folder / "a.mcap", recording);
  const Reader reader = tests::opened(folder / "a.mcap");
  const Summary& summary = reader.summary();
  EXPECT_EQ(summary.schemas.at(1).name, "sensor_msgs/msg/Image");
  EXPECT_EQ(summary.schemas.at(2).data, "string data\n");
  EXPECT_EQ(summary.channels.at(3).topic, "/south/rare");
  EXPECT_EQ(summary.channels.at(4).schema_id, 2);
  EXPECT_EQ(summary.channels.at(1).metadata, (StringMap{{"offered_qos_profiles", ""}}));

  std::map<std::uint16_t, std::uint64_t> counts;
  std::uint64_t first = UINT64_MAX, last = 0;
  for (const auto& set : recording.sets) {
    for (const auto& message : set) {
      ++counts[message.head.channel_id];
      first = std::min(first, message.head.log_time);
      last = std::max(last, message.head.log_time);
    }
  }
  EXPECT_EQ(summary.message_counts, counts);
  EXPECT_EQ(summary.statistics().message_start_time, first);
  EXPECT_EQ(summary.statistics().message_end_time, last);
  EXPECT_EQ(summary.statistics().chunk_count, 30U);
}

TEST(Mcap, HoldsAnEmptyRecording) {
  const tests::TemporaryFolder folder;
  tests::write_recording(folder / "a.mcap", {});
  Reader reader = tests::opened(folder / "a.mcap");
  EXPECT_TRUE(reader.is_finished());
  EXPECT_TRUE(tests::sets_of(reader).empty());
}

TEST(Mcap, IsOpenedByItsSummaryAloneOnlyIfThatIsWhole) {
  const tests::TemporaryFolder folder;
  const auto recording = tests::random_recording(4, 5, 1000);
  auto writer = Writer::create(folder / "a.mcap");
  ASSERT_TRUE(writer);
  tests::write_content(*writer, recording);
  const auto unfinished = Reader::open_finished(folder / "a.mcap");
  ASSERT_FALSE(unfinished);
  EXPECT_EQ(unfinished.error().number, 0);
  EXPECT_EQ(unfinished.error().message,
            (folder / "a.mcap").string() + ": its summary is missing or damaged");
  ASSERT_TRUE(writer->finish());
  auto finished = Reader::open_finished(folder / "a.mcap");
  ASSERT_TRUE(finished) << finished.error().message;
  EXPECT_TRUE(finished->is_finished());
  EXPECT_EQ(tests::sets_of(*finished), recording.sets);

  Bytes damaged = tests::bytes_of(folder / "a.mcap");
  damaged[damaged.size() - kMagic.size() - kFooterSize - 1] ^= std::byte{1};
  const tests::MemoryFile file;
  file.set(damaged);
  EXPECT_FALSE(Reader::open_finished(file.path()));
  Reader scanned = tests::opened(file.path());
  EXPECT_FALSE(scanned.is_finished());
  EXPECT_EQ(tests::sets_of(scanned), recording.sets);
  EXPECT_EQ(Reader::open_finished(folder / "missing").error().number, ENOENT);
}

TEST(Mcap, IsReadWhileItIsWritten) {
  const tests::TemporaryFolder folder;
  const auto recording = tests::random_recording(3, 5, 1000);
  auto writer = Writer::create(folder / "a.mcap");
  ASSERT_TRUE(writer);
  tests::define_channels(*writer);
  std::vector<tests::RecordedSet> written;
  for (const auto& set : recording.sets) {
    tests::write_set(*writer, set);
    Reader before = tests::opened(folder / "a.mcap");
    EXPECT_EQ(tests::sets_of(before), written);
    ASSERT_TRUE(writer->flush());
    written.push_back(set);
    Reader after = tests::opened(folder / "a.mcap");
    EXPECT_EQ(tests::sets_of(after), written);
  }
}

TEST(Writer, RefusesWhatAReaderWouldRefuse) {
  const tests::TemporaryFolder folder;
  auto writer = Writer::create(folder / "a.mcap", {.chunk = 1000});
  ASSERT_TRUE(writer);
  tests::define_channels(*writer);
  EXPECT_EQ(writer->add_channel({0, 77, "/a", "cdr", {}}).error().number, EINVAL);
  EXPECT_FALSE(writer->add_channel({0, 1, "/a\n", "cdr", {}}));
  EXPECT_FALSE(writer->add_schema({0, "", "ros2msg", ""}));
  for (const char* name : {"../a", "a/../b", "/a", "a//b", "", ".", "a\nb"}) {
    EXPECT_FALSE(writer->attach({0, 0, name, "", {}})) << name;
  }
  EXPECT_EQ(writer->write({99, 0, 0, 0}, {}).error().number, EINVAL);
  EXPECT_EQ(Writer::create(folder / "b.mcap", {.chunk = 0}).error().number, EINVAL);
  EXPECT_EQ(Writer::create(folder / "a.mcap").error().number, EEXIST);
}

TEST(Writer, KeepsTheChunkWithinItsBound) {
  const tests::TemporaryFolder folder;
  auto writer = Writer::create(folder / "a.mcap", {.chunk = 2000});
  ASSERT_TRUE(writer);
  tests::define_channels(*writer);
  const Bytes data(1200);
  ASSERT_TRUE(writer->write({1, 0, 10, 10}, data));
  EXPECT_EQ(writer->write({1, 1, 11, 11}, data).error().number, EMSGSIZE);
  ASSERT_TRUE(writer->flush());
  ASSERT_TRUE(writer->write({1, 1, 11, 11}, data));
  ASSERT_TRUE(writer->finish());
  Reader reader = tests::opened(folder / "a.mcap");
  EXPECT_EQ(tests::sets_of(reader).size(), 2U);
}

TEST(Writer, FillsTheSummaryUpToWhatAReaderAccepts) {
  const tests::TemporaryFolder folder;
  auto writer = Writer::create(folder / "a.mcap", {.chunk = 1000});
  ASSERT_TRUE(writer);
  tests::define_channels(*writer);
  std::size_t count = 0;
  for (const std::size_t name : {kMostName, std::size_t{1}}) {
    FileResult<> added;
    while ((added = writer->add_metadata({std::string(name, 'm'), {}}))) ++count;
    EXPECT_EQ(added.error().number, EFBIG);
  }
  ASSERT_TRUE(writer->write({1, 0, 10, 10}, {}));
  EXPECT_EQ(writer->flush().error().number, EFBIG);
  ASSERT_TRUE(writer->finish());
  const Reader reader = tests::opened(folder / "a.mcap");
  EXPECT_EQ(reader.summary().metadata.size(), count);
  EXPECT_GT(count * kMostName, Limits{}.summary / 10 * 9);
}

TEST(Complete, LeavesAFinishedFileAsItIs) {
  const tests::TemporaryFolder folder;
  tests::write_recording(folder / "a.mcap", tests::random_recording(1, 3, 100));
  const Bytes before = tests::bytes_of(folder / "a.mcap");
  const auto completion = complete(folder / "a.mcap");
  ASSERT_TRUE(completion) << completion.error().message;
  EXPECT_TRUE(completion->was_finished);
  EXPECT_EQ(tests::bytes_of(folder / "a.mcap"), before);
}

TEST(Complete, RefusesAFileThatIsBeingWritten) {
  const tests::TemporaryFolder folder;
  auto writer = Writer::create(folder / "a.mcap");
  ASSERT_TRUE(writer);
  EXPECT_EQ(complete(folder / "a.mcap").error().number, EWOULDBLOCK);
}

TEST(Complete, WritesTheFileThatItsWriterWouldHaveFinished) {
  const tests::TemporaryFolder folder;
  const auto recording = tests::random_recording(5, 8, 500);
  tests::write_recording(folder / "whole.mcap", recording);
  {
    auto writer = Writer::create(folder / "cut.mcap");
    ASSERT_TRUE(writer);
    tests::write_content(*writer, recording);
  }
  ASSERT_TRUE(complete(folder / "cut.mcap"));
  EXPECT_EQ(tests::bytes_of(folder / "cut.mcap"), tests::bytes_of(folder / "whole.mcap"));
}

}  // namespace
}  // namespace orbwatch::hal::mcap
