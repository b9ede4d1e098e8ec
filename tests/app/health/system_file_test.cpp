// SPDX-License-Identifier: Apache-2.0
#include "app/health/system_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/app/health/made_up_tree.h"

namespace orbwatch::app {
namespace {

using testing::IsEmpty;
using testing::UnorderedElementsAre;
using tests::MadeUpTree;

TEST(SystemFile, ReadsAtMostItsStart) {
  MadeUpTree tree;
  tree.write("small", "12\n");
  tree.write("large", std::string(100000, 'x'));
  tree.write("empty", "");
  EXPECT_EQ(read_system_file(tree / "small"), "12\n");
  EXPECT_EQ(read_system_file(tree / "large"), std::string(16384, 'x'));
  EXPECT_EQ(read_system_file(tree / "empty"), "");
  EXPECT_EQ(read_system_file("/dev/zero"), std::string(16384, '\0'));
}

TEST(SystemFile, IsNothingWhenItCannotBeRead) {
  MadeUpTree tree;
  tree.make_folder("folder");
  tree.link("dangling", tree / "nowhere");
  tree.link("circle", tree / "circle");
  EXPECT_EQ(read_system_file(tree / "missing"), std::nullopt);
  EXPECT_EQ(read_system_file(tree / "folder"), std::nullopt);
  EXPECT_EQ(read_system_file(tree / "dangling"), std::nullopt);
  EXPECT_EQ(read_system_file(tree / "circle"), std::nullopt);
}

TEST(SystemFile, NeverWaitsForAWriter) {
  MadeUpTree tree;
  ASSERT_EQ(mkfifo((tree / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(read_system_file(tree / "pipe"), "");
}

TEST(Integer, IsTheWholeText) {
  EXPECT_EQ(to_integer("42\n"), 42);
  EXPECT_EQ(to_integer(" \t-7 "), -7);
  EXPECT_EQ(to_integer("50005\n", 16), 0x50005);
  EXPECT_EQ(to_integer("0x50005\n", 16), 0x50005);
  EXPECT_EQ(to_integer("9223372036854775807"), INT64_MAX);
  for (const char* text : {"", " ", "\n", "4 2", "42x", "x42", "4.2", "+4", "0x10", "nan", "--1",
                           "9223372036854775808", "99999999999999999999999999"}) {
    EXPECT_EQ(to_integer(text), std::nullopt) << text;
  }
  EXPECT_EQ(to_integer("0x", 16), std::nullopt);
  EXPECT_EQ(to_integer(std::string_view("4\0002", 3)), std::nullopt);
}

TEST(MemoryLine, IsInBytes) {
  MadeUpTree tree;
  tree.write("meminfo",
             "MemTotal:  2048 kB\nMemFree: 3 MB\nBuffers: -1 kB\nSwap: 9007199254740992 kB\n"
             "Mapped: some kB\n");
  EXPECT_EQ(memory_line(tree / "meminfo", "MemTotal:"), 2048U * 1024);
  for (const char* key : {"MemFree:", "Buffers:", "Swap:", "Mapped:", "Cached:"}) {
    EXPECT_EQ(memory_line(tree / "meminfo", key), std::nullopt) << key;
  }
  EXPECT_EQ(memory_line(tree / "missing", "MemTotal:"), std::nullopt);
}

TEST(Entries, AreThoseThatBeginSo) {
  MadeUpTree tree;
  tree.write("a/zone0", "");
  tree.write("a/zone1", "");
  tree.write("a/other", "");
  EXPECT_THAT(entries(tree / "a", "zone"),
              UnorderedElementsAre(tree / "a/zone0", tree / "a/zone1"));
  EXPECT_EQ(entries(tree / "a").size(), 3U);
  EXPECT_THAT(entries(tree / "missing"), IsEmpty());
  EXPECT_THAT(entries(tree / "a/other"), IsEmpty());
}

}  // namespace
}  // namespace orbwatch::app
