// SPDX-License-Identifier: Apache-2.0
#include "app/update/image_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/update/image_root.h"

namespace orbwatch::app::update::tests {
namespace {

using std::chrono::seconds;

TEST(ImageFilesOnDisk, StateVersionSlotAndCertificate) {
  const ImageRoot root;
  EXPECT_EQ(root.files().version(), "1.9");
  EXPECT_EQ(root.files().slot(), "a");
  EXPECT_TRUE(root.files().accepts_updates());
  root.remove("etc/rauc/keyring.pem");
  EXPECT_FALSE(root.files().accepts_updates());
  root.write("etc/os-release", "ID=debian\nIMAGE_VERSION=1.9\n");
  EXPECT_EQ(root.files().version(), std::nullopt) << "no image of ours";
}

TEST(ImageFilesOnDisk, StateTheTimesOfATrial) {
  const ImageRoot root;
  EXPECT_FALSE(root.files().trial());
  root.try_version(100);
  const auto trial = root.files().trial();
  ASSERT_TRUE(trial);
  EXPECT_GT(trial->returns_in, seconds(100));
  ASSERT_TRUE(trial->kept_in);
  EXPECT_LE(*trial->kept_in, seconds(100));
  root.try_version(-1);
  EXPECT_EQ(root.files().trial()->kept_in, std::nullopt) << "it does not work at present";
  root.write("run/orbwatch-image/trial", "");
  EXPECT_EQ(root.files().trial()->returns_in, seconds(0)) << "times are unknown";
}

TEST(ImageFilesOnDisk, DistinguishAnInstalledVersionFromOneThatWasTried) {
  const ImageRoot root;
  EXPECT_FALSE(root.files().tried());
  ASSERT_TRUE(root.files().prepare_record("1.10"));
  EXPECT_FALSE(root.files().tried()) << "not installed yet";
  ASSERT_TRUE(root.files().keep_record());
  ASSERT_TRUE(root.files().tried());
  EXPECT_EQ(root.files().tried()->version, "1.10");
  EXPECT_TRUE(root.files().tried()->waits_for_start);
  root.restart("second");
  EXPECT_FALSE(root.files().tried()->waits_for_start);
}

TEST(ImageFilesOnDisk, LeaveARecordThatTheImageHasKept) {
  const ImageRoot root;
  EXPECT_FALSE(root.files().keep_record()) << "nothing is prepared";
  ASSERT_TRUE(root.files().prepare_record("1.10"));
  std::filesystem::rename(root.path() / "data/update/tried.new", root.path() / "data/update/tried");
  EXPECT_TRUE(root.files().keep_record());
  EXPECT_EQ(root.files().tried()->version, "1.10");
  root.restart("second");
  EXPECT_FALSE(root.files().keep_record()) << "it is of an earlier start";
}

TEST(ImageFilesOnDisk, TakeARecordOfAnOlderVersionAsTried) {
  const ImageRoot root;
  root.write("data/update/tried", "1.8\n");
  EXPECT_EQ(root.files().tried()->version, "1.8");
  EXPECT_FALSE(root.files().tried()->waits_for_start);
}

TEST(ImageFilesOnDisk, StateTheReasonOfTheSameVersionOnly) {
  const ImageRoot root;
  root.write("data/returned", "1.10\ndegraded: camera top is absent\n");
  EXPECT_EQ(root.files().reason_of_return("1.10"), "degraded: camera top is absent");
  EXPECT_EQ(root.files().reason_of_return("1.11"), "");
}

TEST(ImageFilesOnDisk, RefuseARecordWithoutRoom) {
  const ImageRoot root;
  root.write("data/update", "no folder");
  const auto prepared = root.files().prepare_record("1.10");
  ASSERT_FALSE(prepared);
  EXPECT_THAT(prepared.error().message,
              testing::HasSubstr("data partition is full or has a fault"));
}

}  // namespace
}  // namespace orbwatch::app::update::tests
