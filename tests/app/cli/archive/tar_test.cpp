// SPDX-License-Identifier: Apache-2.0
#include "app/cli/archive/tar.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>

#include "app/cli/archive/compression.h"
#include "app/cli/archive/tar_header.h"
#include "tests/app/cli/archive/frames.h"
#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::cli {
namespace {

using testing::HasSubstr;

constexpr std::chrono::sys_seconds kMade{std::chrono::seconds(1'790'000'000)};
constexpr std::size_t kBlock = 512, kType = 156, kChecksum = 148;

std::string tar_with(const std::string& name, const std::string& bytes = "text") {
  auto tar = tar_of({{name, bytes}}, kMade);
  EXPECT_TRUE(tar) << (tar ? "" : tar.error().message);
  return tar.value_or("");
}

/// The archive with the checksum of its first header put right.
std::string with_right_checksum(std::string tar) {
  tar.replace(kChecksum, 8, 8, ' ');
  unsigned sum = 0;
  for (const char c : tar.substr(0, kBlock)) sum += static_cast<unsigned char>(c);
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "%06o", sum);
  return tar.replace(kChecksum, 7, text.data(), 7);
}

/// The archive with another first name of the same length.
std::string renamed(const std::string& name) {
  std::string tar = tar_with(std::string(name.size(), 'n'));
  return with_right_checksum(tar.replace(0, name.size(), name));
}

std::string refusal_of(const std::string& tar) {
  const auto parsed = parse_tar(tar);
  EXPECT_FALSE(parsed);
  return parsed ? "" : parsed.error().message;
}

TEST(Tar, WhatIsWrittenIsReadAgain) {
  std::mt19937 random(1);
  for (int round = 0; round < 50; ++round) {
    Archive archive;
    const std::size_t files = random() % 8;
    for (std::size_t n = 0; n < files; ++n) {
      std::string bytes(random() % 2000, '\0');
      for (char& c : bytes) c = static_cast<char>(random());
      archive.push_back({std::string(random() % 90 + 1, 'd') + "/" +
                             std::string(random() % 90 + 1, 'f') + std::to_string(n),
                         bytes, static_cast<mode_t>(random() & 0777U)});
    }
    const auto tar = tar_of(archive, kMade);
    ASSERT_TRUE(tar) << tar.error().message;
    const auto read = parse_tar(*tar);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, archive);
  }
}

TEST(Tar, TheSystemsTarUnpacksIt) {
  const tests::TemporaryFolder folder;
  const std::string deep = std::string(90, 'a') + "/" + std::string(60, 'b') + "/c.txt";
  const auto tar = tar_of({{"first", "one\n", 0640}, {deep, std::string(513, 'x'), 0600}}, kMade);
  ASSERT_TRUE(tar);
  std::ofstream(folder / "a.tar", std::ios::binary) << *tar;
  tests::Subprocess program({"/bin/tar", "-C", folder.path(), "-xpf", folder / "a.tar"},
                            folder / "said");
  ASSERT_EQ(program.wait(), 0) << program.output();
  EXPECT_EQ(program.output(), "");
  std::ifstream first(folder / "first"), second(folder / deep);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(first), {}), "one\n");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(second), {}), std::string(513, 'x'));
  struct stat about {};
  ASSERT_EQ(::stat((folder / "first").c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 0777U, 0640U);
  EXPECT_EQ(about.st_mtime, kMade.time_since_epoch().count());
}

TEST(Tar, SizesAboveEightGibibytesAreThoseOfTheSystemsTar) {
  constexpr std::uint64_t kMostOctal = (std::uint64_t{1} << 33) - 1,
                          kMost = (std::uint64_t{1} << 63) - 1;
  for (const std::uint64_t size :
       {kMostOctal, kMostOctal + 1, std::uint64_t{0x123456789a}, kMost}) {
    const auto header = tar_header({"file", size}, kMade);
    ASSERT_TRUE(header) << header.error().message;
    const auto read = parse_tar_header(*header);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->size, size);
  }
  EXPECT_FALSE(tar_header({"file", kMost + 1}, kMade));
  const tests::TemporaryFolder folder;
  const std::string archive = folder / "a.tar";
  const std::uint64_t size = 9'876'543'210;
  std::ofstream(archive, std::ios::binary) << tar_header({"file", size}, kMade).value_or("");
  // The file's bytes and the end have no place on the disk.
  std::filesystem::resize_file(archive, 3 * kBlock + tar_padded(size));
  tests::Subprocess program({"/bin/tar", "-tvf", archive}, folder / "said");
  ASSERT_EQ(program.wait(), 0) << program.output();
  EXPECT_THAT(program.output(), HasSubstr(" " + std::to_string(size) + " "));
}

TEST(Tar, ASizeThatNoFileHasIsRefused) {
  constexpr std::size_t kSize = 124;
  for (const std::string first : {"\x80\x01", "\xff", "\x81"}) {
    std::string tar = tar_with("file");
    tar.replace(kSize, 12, first + std::string(12 - first.size(), '\xff'));
    EXPECT_THAT(refusal_of(with_right_checksum(tar)), HasSubstr("size is damaged"));
  }
}

TEST(Tar, NamesThatLeaveTheFolderAreRefused) {
  for (const char* name :
       {"/etc/passwd", "../up", "a/../../up", "a//b", "./a", "a/.", "..", "a/"}) {
    EXPECT_FALSE(tar_of({{name, ""}}, kMade)) << name;
    EXPECT_THAT(refusal_of(renamed(name)), HasSubstr("is not a relative path")) << name;
  }
  EXPECT_THAT(refusal_of(renamed("a\nb")), HasSubstr("a?b"));
  EXPECT_FALSE(tar_of({{std::string(101, 'n'), ""}}, kMade)) << "has no slash to split at";
}

TEST(Tar, OnlyRegularFilesAreRead) {
  for (const char type : {'1', '2', '3', '4', '5', '6', '7', 'x', 'g', 'L', 'K', 'S'}) {
    std::string tar = tar_with("file");
    tar[kType] = type;
    EXPECT_THAT(refusal_of(with_right_checksum(tar)), HasSubstr("is not a regular file")) << type;
  }
}

TEST(Tar, WhatIsDamagedIsRefused) {
  const std::string tar = tar_with("file", std::string(600, 'x'));
  for (std::size_t size = 0; size < tar.size() - kBlock; size += 7) {
    EXPECT_THAT(refusal_of(tar.substr(0, size)), HasSubstr("cut off")) << size;
  }
  for (std::size_t at = 0; at < kBlock; ++at) {
    std::string damaged = tar;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x15);
    EXPECT_FALSE(parse_tar(damaged)) << at;
  }
  const std::size_t kSize = 124;
  std::string huge = tar;
  huge.replace(kSize, 11, "77777777777");
  EXPECT_THAT(refusal_of(with_right_checksum(huge)), HasSubstr("cut off"));
  EXPECT_THAT(refusal_of(tar + "more"), HasSubstr("after its end"));
  const std::string without_end = tar.substr(0, tar.size() - 2 * kBlock);
  EXPECT_THAT(refusal_of(without_end + tar), HasSubstr("twice"));
}

TEST(Tar, TheNumberOfFilesIsLimited) {
  Archive archive;
  for (std::size_t n = 0; n <= kMostArchivedFiles; ++n) archive.push_back({std::to_string(n), ""});
  const auto tar = tar_of(archive, kMade);
  ASSERT_TRUE(tar);
  EXPECT_THAT(refusal_of(*tar), HasSubstr("more than 4096"));
}

TEST(Compression, KeepsBytesAndRefusesWhatIsDamaged) {
  const std::string text(100'000, 'x');
  const auto frame = compressed(text);
  ASSERT_TRUE(frame);
  EXPECT_LT(frame->size(), 1000U);
  EXPECT_EQ(decompressed(*frame, text.size()).value_or(""), text);
  EXPECT_EQ(decompressed(compressed("").value_or(""), 0).value_or("none"), "");
  for (std::size_t size = 0; size < frame->size(); ++size) {
    EXPECT_FALSE(decompressed(frame->substr(0, size), text.size())) << size;
  }
  for (std::size_t at = 0; at < frame->size(); ++at) {
    std::string damaged = *frame;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x11);
    const auto read = decompressed(damaged, text.size());
    EXPECT_TRUE(!read || *read == text) << at;
  }
  EXPECT_FALSE(decompressed(*frame + "x", text.size()));
}

TEST(Frames, KeepBytesOfAnyLengthInAnyPieces) {
  std::mt19937 random(3);
  std::string text(1'000'000, '\0');
  for (char& c : text) c = static_cast<char>(random() % 7);
  for (const std::size_t piece : {1UL, 777UL, 131'072UL, text.size()}) {
    std::string frames;
    for (int n = 0; n < 2; ++n) {
      FrameWriter writer([&](std::string_view bytes) -> Result<> {
        frames += bytes;
        return {};
      });
      for (std::size_t at = 0; at < text.size(); at += piece * 100) {
        ASSERT_TRUE(writer.add(std::string_view(text).substr(at, piece * 100)));
      }
      ASSERT_TRUE(writer.finish());
    }
    FrameReader reader = frames_of(frames, piece);
    for (int n = 0; n < 2; ++n) {
      ASSERT_TRUE(reader.next().value_or(false));
      std::string part(10, '\0');
      ASSERT_EQ(reader.read(part).value_or(0), part.size());
      EXPECT_EQ(part + reader.read_all(text.size()).value_or(""), text);
    }
    EXPECT_FALSE(reader.next().value_or(true));
  }
}

TEST(Frames, AFrameIsReadToItsEndBeforeTheNext) {
  FrameReader reader = frames_of(compressed("text").value_or(""));
  ASSERT_TRUE(reader.next().value_or(false));
  EXPECT_FALSE(reader.next());
}

TEST(Frames, ErrorsOfTheSinkAreThoseOfTheWriter) {
  FrameWriter writer([](std::string_view) -> Result<> { return fail("full"); });
  auto written = writer.add(std::string(10, 'x'));
  if (written) written = writer.finish();
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().message, "full");
}

TEST(Compression, ASmallFileDoesNotBecomeALargeOne) {
  const auto bomb = compressed(std::string(std::size_t{64} << 20, '\0'));
  ASSERT_TRUE(bomb);
  const auto read = decompressed(*bomb, std::size_t{1} << 20);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message, "is larger than 1 MiB");
}

}  // namespace
}  // namespace orbwatch::app::cli
