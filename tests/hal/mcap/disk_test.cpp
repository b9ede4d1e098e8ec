// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

#include "hal/mcap/completion.h"
#include "hal/mcap/reader.h"
#include "hal/mcap/writer.h"
#include "tests/hal/mcap/recording.h"
#include "tests/support/require.h"
#include "tests/support/service_user.h"
#include "tests/support/small_disk.h"
#include "tests/support/temporary_folder.h"

/// Disks that refuse to write. Each runs in a process of its own, whose limits and mounts it
/// changes.
namespace orbwatch::hal::mcap {
namespace {

using tests::expect_in_a_process;
using tests::mount_small_disk;

/// Writes sets until the disk is full; returns the errno.
int fill(Writer& writer, const tests::Recording& recording, std::size_t& kept) {
  for (kept = 0; kept < recording.sets.size(); ++kept) {
    tests::write_set(writer, recording.sets[kept]);
    if (auto flushed = writer.flush(); !flushed) return flushed.error().number;
  }
  return 0;
}

void expect_sets(const std::filesystem::path& path, const std::vector<tests::RecordedSet>& sets) {
  Reader reader = tests::opened(path);
  EXPECT_EQ(tests::sets_of(reader), sets);
}

TEST(McapDisk, FullCostsOneSetAndWritingGoesOn) {
  ORBWATCH_WITHOUT_ROOT_SKIPPED();
  const tests::TemporaryFolder folder;
  expect_in_a_process([&] {
    mount_small_disk(folder.path(), "size=256k");
    { std::ofstream(folder / "other") << std::string(100'000, 'x'); }
    auto recording = tests::random_recording(1, 400, 3000);
    auto writer = Writer::create(folder / "a.mcap", {.is_compressed = false});
    tests::require(writer.has_value());
    tests::define_channels(*writer);
    std::size_t kept = 0;
    EXPECT_EQ(fill(*writer, recording, kept), ENOSPC);
    ASSERT_GT(kept, 5U);
    ASSERT_LT(kept + 1, recording.sets.size());
    auto sets = std::vector(recording.sets.begin(),
                            recording.sets.begin() + static_cast<std::ptrdiff_t>(kept));
    expect_sets(folder / "a.mcap", sets);

    std::filesystem::remove(folder / "other");
    tests::write_set(*writer, recording.sets[kept + 1]);
    sets.push_back(recording.sets[kept + 1]);
    ASSERT_TRUE(writer->flush());
    const auto finished = writer->finish();
    ASSERT_TRUE(finished) << finished.error().message;
    expect_sets(folder / "a.mcap", sets);
    EXPECT_TRUE(tests::opened(folder / "a.mcap").is_finished());
  });
}

TEST(McapDisk, FullBeforeTheFirstSetDoesNotLoseDefinitions) {
  ORBWATCH_WITHOUT_ROOT_SKIPPED();
  const tests::TemporaryFolder folder;
  expect_in_a_process([&] {
    mount_small_disk(folder.path(), "size=64k");
    auto writer = Writer::create(folder / "a.mcap");
    tests::require(writer.has_value());
    tests::define_channels(*writer);
    { std::ofstream(folder / "other") << std::string(100'000, 'x'); }
    std::mt19937 random(7);
    const std::vector sets{tests::random_set(random, 0, 1, 20'000),
                           tests::random_set(random, 1, 1, 5000)};
    tests::write_set(*writer, sets[0]);
    EXPECT_EQ(writer->flush().error().number, ENOSPC);
    std::filesystem::remove(folder / "other");
    tests::write_set(*writer, sets[1]);
    ASSERT_TRUE(writer->finish());
    expect_sets(folder / "a.mcap", {sets[1]});
  });
}

TEST(McapDisk, FullLeavesAFileThatIsCompletedLater) {
  ORBWATCH_WITHOUT_ROOT_SKIPPED();
  const tests::TemporaryFolder folder;
  expect_in_a_process([&] {
    mount_small_disk(folder.path(), "size=64k");
    const auto recording = tests::random_recording(2, 2000, 40);
    std::size_t kept = 0;
    {
      auto writer = Writer::create(folder / "a.mcap", {.is_compressed = false});
      tests::require(writer.has_value());
      tests::define_channels(*writer);
      EXPECT_EQ(fill(*writer, recording, kept), ENOSPC);
      EXPECT_EQ(writer->finish().error().number, ENOSPC);
    }
    const auto sets = std::vector(recording.sets.begin(),
                                  recording.sets.begin() + static_cast<std::ptrdiff_t>(kept));
    EXPECT_EQ(complete(folder / "a.mcap").error().number, ENOSPC);
    expect_sets(folder / "a.mcap", sets);
    tests::require(::mount("", folder.path().c_str(), nullptr, MS_REMOUNT, "size=1m") == 0);
    ASSERT_TRUE(complete(folder / "a.mcap"));
    expect_sets(folder / "a.mcap", sets);
  });
}

TEST(McapDisk, ReadOnlyIsAnErrorOfItsOwn) {
  ORBWATCH_WITHOUT_ROOT_SKIPPED();
  const tests::TemporaryFolder folder;
  expect_in_a_process([&] {
    mount_small_disk(folder.path(), "size=256k");
    {
      auto writer = Writer::create(folder / "a.mcap");
      tests::require(writer.has_value());
      tests::write_content(*writer, tests::random_recording(3, 3, 100));
    }
    tests::require(::mount("", folder.path().c_str(), nullptr, MS_REMOUNT | MS_RDONLY, "") == 0);
    EXPECT_EQ(Writer::create(folder / "b.mcap").error().number, EROFS);
    EXPECT_EQ(complete(folder / "a.mcap").error().number, EROFS);
    Reader reader = tests::opened(folder / "a.mcap");
    EXPECT_EQ(tests::sets_of(reader).size(), 3U);
  });
}

TEST(McapDisk, LimitOfTheFileSizeIsAnError) {
  const tests::TemporaryFolder folder;
  expect_in_a_process([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{50'000, 50'000};
    tests::require(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
    const auto recording = tests::random_recording(4, 400, 3000);
    auto writer = Writer::create(folder / "a.mcap");
    tests::require(writer.has_value());
    tests::define_channels(*writer);
    std::size_t kept = 0;
    EXPECT_EQ(fill(*writer, recording, kept), EFBIG);
    expect_sets(folder / "a.mcap",
                std::vector(recording.sets.begin(),
                            recording.sets.begin() + static_cast<std::ptrdiff_t>(kept)));
  });
}

TEST(McapDisk, FullInItsFirstBytesLeavesNoFile) {
  const tests::TemporaryFolder folder;
  expect_in_a_process([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{10, 10};
    tests::require(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
    EXPECT_EQ(Writer::create(folder / "a.mcap").error().number, EFBIG);
    EXPECT_EQ(folder.files(), 0);
  });
}

TEST(McapDisk, OtherFilesThanRegularOnesAreRefused) {
  const tests::TemporaryFolder folder;
  tests::require(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  for (const auto& path : {std::filesystem::path("/dev/full"), folder / "pipe", folder.path()}) {
    EXPECT_FALSE(Reader::open(path)) << path;
    EXPECT_FALSE(complete(path)) << path;
  }
  EXPECT_EQ(Reader::open(folder / "missing").error().number, ENOENT);
}

}  // namespace
}  // namespace orbwatch::hal::mcap
