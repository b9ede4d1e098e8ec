// SPDX-License-Identifier: Apache-2.0
#include "app/health/disk_writes.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <string>

#include "proc/signals/signals.h"
#include "tests/app/health/made_up_tree.h"

namespace orbwatch::app {
namespace {

using signals::is_valid;

/// A card with the partition that has the temporary folder: 2 GiB written, a day after power-on.
class DiskWrites : public testing::Test {
 protected:
  static constexpr const char* kCard = "sys/devices/mmc/block/mmcblk0";

  DiskWrites() {
    tree.write("proc/uptime", "86400.00 170000.12\n");
    tree.write(std::string(kCard) + "/stat", "8 1 900 3 70 5 4194304 9 0 4 12 0 0 0 0 0 0\n");
    tree.write(std::string(kCard) + "/mmcblk0p2/partition", "2\n");
    tree.write(std::string(kCard) + "/mmcblk0p2/stat", "1 1 1 1 1 1 8 1 0 1 1 0 0 0 0 0 0\n");
    tree.link(number_of_this_disk(), tree / (std::string(kCard) + "/mmcblk0p2"));
  }

  std::string number_of_this_disk() const {
    struct stat found {};
    EXPECT_EQ(::stat(tree.path().c_str(), &found), 0);
    return "sys/dev/block/" + std::to_string(major(found.st_dev)) + ":" +
           std::to_string(minor(found.st_dev));
  }
  double per_day() const { return disk_written_per_day(tree / "sys", tree / "proc", tree.path()); }

  tests::MadeUpTree tree;
};

TEST_F(DiskWrites, AreThoseToTheWholeCard) {
  EXPECT_DOUBLE_EQ(per_day(), 2048);
  tree.write("proc/uptime", "43200.00 0\n");
  EXPECT_DOUBLE_EQ(per_day(), 4096);
}

TEST_F(DiskWrites, OfADiskWithoutPartitionsAreItsOwn) {
  tree.remove(std::string(kCard) + "/mmcblk0p2/partition");
  EXPECT_DOUBLE_EQ(per_day(), 8.0 * 512 / (1 << 20));
}

TEST_F(DiskWrites, AreNotValidSoonAfterPowerOn) {
  tree.write("proc/uptime", "599.99 1\n");
  EXPECT_FALSE(is_valid(per_day()));
  tree.write("proc/uptime", "600.00 1\n");
  EXPECT_TRUE(is_valid(per_day()));
}

TEST_F(DiskWrites, AreNotValidWithoutABlockDevice) {
  tree.remove(number_of_this_disk());
  EXPECT_FALSE(is_valid(per_day()));
  EXPECT_FALSE(is_valid(disk_written_per_day(tree / "sys", tree / "proc", tree / "absent")));
}

TEST_F(DiskWrites, AreNotValidWithDamagedFiles) {
  for (const char* text :
       {"", "1 2 3", "1 1 1 1 1 1 -5 1", "1 1 1 1 1 1 x 1", "1 1 1 1 1 1 99999999999999999999 1"}) {
    tree.write(std::string(kCard) + "/stat", text);
    EXPECT_FALSE(is_valid(per_day())) << text;
  }
  tree.write(std::string(kCard) + "/stat", "1 1 1 1 1 1 8 1\n");
  for (const char* text : {"", "-1 1", "nan 1", "86400", "0 0", "one 1"}) {
    tree.write("proc/uptime", text);
    EXPECT_FALSE(is_valid(per_day())) << text;
  }
}

}  // namespace
}  // namespace orbwatch::app
