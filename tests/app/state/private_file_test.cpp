// SPDX-License-Identifier: Apache-2.0
#include "app/state/private_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <atomic>
#include <fstream>
#include <thread>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace orbwatch::app {
namespace {

using orbwatch::tests::TemporaryFolder;
using testing::HasSubstr;

mode_t mode_of(const std::filesystem::path& file) {
  struct stat about {};
  EXPECT_EQ(::stat(file.c_str(), &about), 0) << file;
  return about.st_mode & 07777;
}

/// orbwatchd and `orbwatch password` write the same marker.
TEST(PrivateFile, IsWrittenByTwoAtATime) {
  const TemporaryFolder folder;
  const auto file = folder / "secret";
  std::atomic<int> failures = 0;
  const auto write = [&](const std::string& text) {
    for (int n = 0; n < 100; ++n) failures += write_private(file, text) ? 0 : 1;
  };
  std::thread other(write, "theirs");
  write("ours");
  other.join();
  EXPECT_EQ(failures, 0);
  const std::string text = read_private(file).value().value_or("");
  EXPECT_TRUE(text == "ours" || text == "theirs") << text;
  const auto files = std::distance(std::filesystem::directory_iterator(folder.path()), {});
  EXPECT_EQ(files, 1) << "nothing is left";
}

TEST(PrivateFile, IsReadAsWrittenByItsOwnerOnly) {
  const TemporaryFolder folder;
  const auto file = folder / "new/secret";
  EXPECT_EQ(read_private(file).value(), std::nullopt);
  for (const std::string text : {"first", "", "a longer text\n"}) {
    ASSERT_TRUE(write_private(file, text));
    EXPECT_EQ(read_private(file).value(), text);
    EXPECT_EQ(mode_of(file), 0600U);
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "new"), {}), 1);
}

TEST(PrivateFile, WhatOthersMayUseIsRefused) {
  const TemporaryFolder folder;
  const auto file = folder / "secret";
  ASSERT_TRUE(write_private(file, "text"));
  for (const mode_t mode : {0640U, 0604U, 0620U, 0602U, 0666U}) {
    ::chmod(file.c_str(), mode);
    const auto text = read_private(file);
    ASSERT_FALSE(text) << mode;
    EXPECT_THAT(text.error().message, HasSubstr("600 by chmod"));
  }
}

TEST(PrivateFile, ALinkOrAFolderIsRefused) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_private(folder / "target", "text"));
  std::filesystem::create_symlink(folder / "target", folder / "link");
  std::filesystem::create_directory(folder / "folder");
  EXPECT_FALSE(read_private(folder / "link"));
  EXPECT_FALSE(read_private(folder / "folder"));
  // Writing replaces the link and keeps the target.
  ASSERT_TRUE(write_private(folder / "link", "other"));
  EXPECT_EQ(read_private(folder / "target").value(), "text");
  EXPECT_EQ(read_private(folder / "link").value(), "other");
}

TEST(PrivateFile, OneBeyondItsSizeIsRefused) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_private(folder / "large", std::string((1U << 20U) + 1, 'x')));
  EXPECT_FALSE(read_private(folder / "large"));
}

TEST(PrivateFile, AReaderFindsAWholeTextWhileOthersWrite) {
  const TemporaryFolder folder;
  const auto file = folder / "secret";
  ASSERT_TRUE(write_private(file, std::string(5000, 'a')));
  std::atomic<bool> is_done{false};
  std::thread writer([&] {
    for (int i = 0; i < 200; ++i) {
      EXPECT_TRUE(write_private(file, std::string(5000 + static_cast<std::size_t>(i), 'b')));
    }
    is_done = true;
  });
  while (!is_done) {
    const std::string text = read_private(file).value().value();
    EXPECT_TRUE(text.size() >= 5000 && text.find_first_not_of(text.front()) == std::string::npos);
  }
  writer.join();
}

TEST(PrivateFile, ChangesUnderTheLockAreNotLost) {
  const TemporaryFolder folder;
  const auto file = folder / "counter";
  ASSERT_TRUE(write_private(file, "0"));
  constexpr int kThreads = 4, kChanges = 25;
  std::vector<std::thread> threads;
  threads.reserve(kThreads);
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&] {
      for (int k = 0; k < kChanges; ++k) {
        EXPECT_TRUE(with_lock(file, [&] {
          return write_private(file, std::to_string(std::stoi(*read_private(file).value()) + 1));
        }));
      }
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(read_private(file).value(), std::to_string(kThreads * kChanges));
}

TEST(PrivateFile, AFolderThatCannotBeIsAnErrorThatNamesIt) {
  const auto written = write_private("/proc/orbwatch/secret", "text");
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, HasSubstr("/proc/orbwatch"));
}

}  // namespace
}  // namespace orbwatch::app
