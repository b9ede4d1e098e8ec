// SPDX-License-Identifier: Apache-2.0
#include "app/state/slot_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/app/state/damaged_disk.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app {
namespace {

using testing::HasSubstr;
using tests::bytes_of;
using tests::FullDisk;
using tests::set_bytes;

/// Content that differs from every other in most of its bytes.
SlotFile::Content content(std::uint8_t number) {
  SlotFile::Content made{};
  for (std::size_t i = 0; i < made.size(); ++i) {
    made[i] = static_cast<std::byte>(i * 31 + number * 7U + 1);
  }
  return made;
}

class SlotFileTest : public testing::Test {
 protected:
  std::unique_ptr<SlotFile> open() const {
    auto opened = SlotFile::open(file_);
    EXPECT_TRUE(opened) << opened.error().message;
    return opened ? std::move(*opened) : nullptr;
  }
  std::string refusal() const {
    const auto opened = SlotFile::open(file_);
    return opened ? "opened" : opened.error().message;
  }

  const orbwatch::tests::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "state/value";
};

TEST_F(SlotFileTest, BeginsWithZerosAndKeepsWhatIsWritten) {
  EXPECT_EQ(open()->content(), SlotFile::Content{});
  for (std::uint8_t number = 1; number < 6; ++number) {
    const auto file = open();
    ASSERT_TRUE(file->write(content(number)));
    EXPECT_EQ(file->content(), content(number));
  }
  EXPECT_EQ(open()->content(), content(5));
  EXPECT_EQ(bytes_of(file_).size(), SlotFile::kFileSize);
}

TEST_F(SlotFileTest, AWriteTornAtAnyByteLeavesTheValueBefore) {
  ASSERT_TRUE(open()->write(content(1)));
  const std::string before = bytes_of(file_);
  ASSERT_TRUE(open()->write(content(2)));
  const std::string after = bytes_of(file_);
  // A disk may write the first bytes of a slot first, or the last ones.
  for (const bool is_begin_first : {true, false}) {
    set_bytes(file_, before);
    std::fstream torn(file_, std::ios::binary | std::ios::in | std::ios::out);
    std::string bytes = before;
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      const std::size_t at = is_begin_first ? n : bytes.size() - 1 - n;
      if (bytes[at] == after[at]) continue;
      bytes[at] = after[at];
      torn.seekp(static_cast<std::streamoff>(at)).put(after[at]).flush();
      const auto read = open();
      ASSERT_TRUE(read->content()) << "at " << at;
      ASSERT_EQ(read->content(), bytes == after ? content(2) : content(1)) << "at " << at;
    }
    ASSERT_EQ(bytes_of(file_), after);
  }
}

TEST_F(SlotFileTest, OfTwoDamagedSlotsNothingIsLeft) {
  ASSERT_TRUE(open()->write(content(1)));
  std::string bytes = bytes_of(file_);
  bytes[100] ^= 1;
  bytes[SlotFile::kSlotSize + 100] ^= 1;
  set_bytes(file_, bytes);
  {
    const auto damaged = open();
    ASSERT_FALSE(damaged->content());
    EXPECT_THAT(damaged->content().error().message, HasSubstr("is damaged in both"));
    ASSERT_TRUE(damaged->write(content(2)));
  }
  EXPECT_EQ(open()->content(), content(2));
}

TEST_F(SlotFileTest, ACutFileIsDamagedAndNotNew) {
  open();
  set_bytes(file_, "");
  EXPECT_FALSE(open()->content());
}

TEST_F(SlotFileTest, TellsTheVersionThatItDoesNotRead) {
  ASSERT_TRUE(open()->write(content(1)));
  std::string bytes = bytes_of(file_);
  bytes[8] = 2;  // part of the first slot, which the first write may have used
  bytes[SlotFile::kSlotSize + 8] = 2;
  set_bytes(file_, bytes);
  const auto other = open();
  ASSERT_FALSE(other->content());
  EXPECT_THAT(other->content().error().message, HasSubstr("is of version 2; "));
}

TEST_F(SlotFileTest, AnOlderSlotOfThisVersionDoesNotStandInForANewerOneOfAnother) {
  auto file = open();
  ASSERT_TRUE(file->write(content(1)));
  const std::string before = bytes_of(file_);
  ASSERT_TRUE(file->write(content(2)));
  file.reset();
  std::string bytes = bytes_of(file_);
  const std::size_t newest =
      bytes.compare(0, SlotFile::kSlotSize, before, 0, SlotFile::kSlotSize) != 0
          ? 0
          : SlotFile::kSlotSize;
  bytes[newest + 8] = 2;
  set_bytes(file_, bytes);
  EXPECT_FALSE(open()->content());
}

TEST_F(SlotFileTest, BelongsToOneProcess) {
  {
    const auto file = open();
    EXPECT_THAT(refusal(), HasSubstr("is used by another orbwatchd; set a different state_folder"));
  }
  EXPECT_EQ(refusal(), "opened");
}

TEST_F(SlotFileTest, NeedsAFolderThatItMayWriteTo) {
  // No user can write there, not even root.
  const auto read_only = SlotFile::open("/proc/orbwatch/value");
  ASSERT_FALSE(read_only);
  EXPECT_THAT(read_only.error().message, HasSubstr("/proc/orbwatch: cannot be opened"));
  const auto no_file = SlotFile::open("/proc/value");
  ASSERT_FALSE(no_file);
  EXPECT_THAT(no_file.error().message, HasSubstr("/proc/value: cannot be written"));
  set_bytes(folder_ / "file", "");
  EXPECT_FALSE(SlotFile::open(folder_ / "file/value"));
}

TEST_F(SlotFileTest, OnAFullDiskItIsNotBegunAndLaterIs) {
  {
    const FullDisk full(SlotFile::kSlotSize + 1);
    EXPECT_THAT(refusal(), HasSubstr("cannot be written: File too large"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(file_.parent_path())) << "nothing is left of it";
  EXPECT_EQ(open()->content(), SlotFile::Content{}) << "what was begun is not taken for damaged";
}

TEST_F(SlotFileTest, AFailedWriteLosesNothing) {
  {
    const auto file = open();
    ASSERT_TRUE(file->write(content(1)));
    {
      // Only the first slot is written, and only in part.
      const FullDisk full(1000);
      EXPECT_FALSE(file->write(content(2)));
      EXPECT_FALSE(file->write(content(3)));
    }
    EXPECT_EQ(file->content(), content(1));
  }
  EXPECT_EQ(open()->content(), content(1));
  ASSERT_TRUE(open()->write(content(4)));
  EXPECT_EQ(open()->content(), content(4));
}

}  // namespace
}  // namespace orbwatch::app
