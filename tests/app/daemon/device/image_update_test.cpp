// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/device/image_update.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "app/daemon/device/uploaded_file.h"
#include "app/ports/recorder/recorder_settings.h"
#include "tests/app/update/fake_rauc.h"
#include "tests/app/update/image_root.h"
#include "tests/support/comes_true.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::daemon::tests {
namespace {

using orbwatch::tests::comes_true;
using testing::ElementsAre;
using testing::HasSubstr;
using Trial = DeviceUpdate::Trial;
using Work = DeviceUpdate::Work;

const std::string kNewer = "bundle orbwatch-amd64 1.10";

class DeviceWithSlots : public testing::Test {
 protected:
  void SetUp() override { ::setenv("DBUS_SYSTEM_BUS_ADDRESS", rauc_.address().c_str(), 1); }
  void TearDown() override { ::unsetenv("DBUS_SYSTEM_BUS_ADDRESS"); }

  std::unique_ptr<ImageUpdate> device(std::uint64_t reserve = 0) {
    return std::make_unique<ImageUpdate>(ImageUpdate::Settings{
        .image = root_.files(), .folder = spool_, .reserve = reserve, .restart_device = [this] {
          ++restarts_;
        }});
  }
  /// Uploads a whole bundle in two parts, and begins its installation.
  static void send(DeviceUpdate& device, const std::string& bundle) {
    const std::size_t half = bundle.size() / 2;
    ASSERT_EQ(device.upload(0, bundle.size(), bundle.substr(0, half)), half);
    ASSERT_EQ(device.upload(half, bundle.size(), bundle.substr(half)), bundle.size());
    ASSERT_TRUE(device.install());
  }
  /// Why a bundle is refused.
  std::string refusal_of(const std::string& bundle) {
    const auto refusing = device();
    send(*refusing, bundle);
    EXPECT_TRUE(comes_true([&] { return refusing->state().work == Work::None; }));
    EXPECT_FALSE(std::filesystem::exists(spool_)) << "the bundle is deleted";
    EXPECT_EQ(refusing->state().trial, Trial::Kept);
    return refusing->state().failure;
  }

  const update::tests::ImageRoot root_;
  const std::filesystem::path spool_ = root_.path() / "spool";
  update::tests::FakeRauc rauc_{root_.path()};
  std::atomic<int> restarts_ = 0;
};

TEST_F(DeviceWithSlots, InstallsAnUploadedUpdateAndRestartsForIt) {
  const auto updated = device();
  EXPECT_FALSE(updated->restart_device()) << "nothing is installed";
  send(*updated, kNewer);
  ASSERT_TRUE(comes_true([&] { return updated->state().percent == 40; }));
  EXPECT_EQ(updated->state().work, Work::Installing);
  EXPECT_THAT(updated->state().step, HasSubstr("Copying"));
  EXPECT_THAT(updated->upload(0, 1, "x").error().message, HasSubstr("is being installed"));
  EXPECT_THAT(updated->install().error().message, HasSubstr("is being installed"));
  EXPECT_TRUE(std::filesystem::exists(spool_ / "update.raucb"));
  rauc_.finish();
  ASSERT_TRUE(comes_true([&] { return updated->state().work == Work::None; }));
  EXPECT_EQ(updated->state().trial, Trial::Installed);
  EXPECT_EQ(updated->state().other, "1.10");
  EXPECT_EQ(updated->state().failure, "");
  EXPECT_FALSE(std::filesystem::exists(spool_));
  EXPECT_THAT(rauc_.installed(), ElementsAre(spool_ / "update.raucb"));
  EXPECT_TRUE(updated->restart_device());
  EXPECT_EQ(restarts_, 1);
}

TEST_F(DeviceWithSlots, RefusesInASentence) {
  EXPECT_THAT(refusal_of("foreign"),
              HasSubstr("the update is refused: it is not signed by the key"));
  EXPECT_THAT(refusal_of("trunc"), HasSubstr("incomplete or not an update"));
  EXPECT_THAT(refusal_of("bundle orbwatch-amd64 1.8"), HasSubstr("is older than the running one"));
  EXPECT_THAT(refusal_of("bundle orbwatch-arm64 1.10"),
              HasSubstr("devices of kind orbwatch-arm64"));
  EXPECT_THAT(rauc_.installed(), ElementsAre());
}

TEST_F(DeviceWithSlots, ReportsAFailedInstallation) {
  rauc_.finish("Failed to write the slot: I/O error");
  EXPECT_THAT(refusal_of(kNewer), HasSubstr("not installed: Failed to write the slot"));
}

TEST_F(DeviceWithSlots, TakesNoUpdateDuringATrialOrWithoutACertificate) {
  const auto trying = device();
  root_.try_version(60);
  EXPECT_THAT(trying->upload(0, 4, "x").error().message, HasSubstr("is on trial"));
  EXPECT_EQ(trying->state().trial, Trial::OnTrial);
  EXPECT_TRUE(trying->state().kept_in);
  root_.remove("run/orbwatch-image/trial");
  root_.remove("etc/rauc/keyring.pem");
  EXPECT_THAT(trying->upload(0, 4, "x").error().message, HasSubstr("accepts no update"));
  EXPECT_THAT(trying->state().refusal, HasSubstr("accepts no update"));
}

TEST_F(DeviceWithSlots, KeepsTheReserveFree) {
  constexpr std::uint64_t kLarge = std::uint64_t{1} << 60;
  const auto full = device(kLarge);
  const auto refused = full->upload(0, 4, "bund");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("no room"));
  EXPECT_THAT(device()->upload(0, kLarge, "bund").error().message, HasSubstr("no room"));
}

TEST_F(DeviceWithSlots, TakesPartsInOrderOnly) {
  const auto receiving = device();
  EXPECT_THAT(receiving->upload(0, 0, "").error().message, HasSubstr("is empty"));
  EXPECT_THAT(receiving->upload(4, 8, "x").error().message, HasSubstr("size must be 0"));
  ASSERT_TRUE(receiving->upload(0, 8, "abcd"));
  EXPECT_EQ(receiving->state().percent, 50);
  EXPECT_THAT(receiving->upload(2, 8, "x").error().message, HasSubstr("offset must be 4"));
  EXPECT_THAT(receiving->upload(4, 9, "x").error().message, HasSubstr("size must be 8"));
  EXPECT_THAT(receiving->upload(4, 8, "abcde").error().message, HasSubstr("more bytes than"));
  EXPECT_THAT(receiving->install().error().message, HasSubstr("completely"));
  ASSERT_EQ(receiving->upload(0, 2, "ab"), 2U) << "begins anew";
  EXPECT_TRUE(std::filesystem::exists(spool_ / "update.raucb"));
  EXPECT_FALSE(std::filesystem::exists(spool_ / "update.raucb.part"));
}

TEST_F(DeviceWithSlots, DeletesWhatAnEarlierRunLeft) {
  root_.write("spool/update.raucb", "old");
  const auto started = device();
  EXPECT_FALSE(std::filesystem::exists(spool_));
}

TEST_F(DeviceWithSlots, StatesWhyItReturned) {
  const auto returned = device();
  root_.write("data/update/tried", "1.10\nbefore\n");
  EXPECT_EQ(returned->state().trial, Trial::Returned);
  EXPECT_EQ(returned->state().other, "1.10");
  EXPECT_THAT(returned->state().reason, HasSubstr("lost its power"));
  root_.write("data/returned", "1.10\ndegraded: camera top is absent\n");
  EXPECT_EQ(returned->state().reason, "degraded: camera top is absent");
}

TEST_F(DeviceWithSlots, EndsDuringAnInstallation) {
  const auto ending = device();
  send(*ending, kNewer);
  ASSERT_TRUE(comes_true([&] { return ending->state().work == Work::Installing; }));
  ending->cancel();
  EXPECT_TRUE(comes_true([&] { return ending->state().work == Work::None; }));
  EXPECT_THAT(ending->state().failure, HasSubstr("not installed"));
}

TEST_F(DeviceWithSlots, ReportsThatRaucIsMissing) {
  ::setenv("DBUS_SYSTEM_BUS_ADDRESS", "unix:path=/nowhere/bus", 1);
  EXPECT_THAT(refusal_of(kNewer), HasSubstr("no system bus"));
}

TEST(BackupUpload, KeepsTheReserveFree) {
  constexpr std::uint64_t kLarge = std::uint64_t{1} << 60;
  const orbwatch::tests::TemporaryFolder folder;
  BackupUpload full(folder / "upload", kLarge);
  EXPECT_EQ(full.add(0, "back"), 4U) << "a small one";
  EXPECT_THAT(full.add(BackupUpload::kSmall, "up").error().message, HasSubstr("no room"));
  BackupUpload empty(folder / "upload", 0);
  EXPECT_THAT(empty.add(BackupUpload::kSmall, "up").error().message, HasSubstr("offset must be 4"))
      << "there is room";
  EXPECT_THAT(empty.add(BackupUpload::kMost, "up").error().message, HasSubstr("is larger than"));
}

TEST(BackupUpload, KeepsTheRecordersReserveIfThereIsARecorder) {
  constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20;
  RecorderSettings recorder;
  recorder.reserve_mib = 5000;
  EXPECT_EQ(backup_reserve(recorder), BackupUpload::kSmall);
  recorder.folder = "recordings";
  EXPECT_EQ(backup_reserve(recorder), 5000 * kMebibyte);
}

TEST(BackupUpload, IsRemovedAfterAPause) {
  const orbwatch::tests::TemporaryFolder folder;
  BackupUpload abandoned(folder / "abandoned", 0, std::chrono::milliseconds(1));
  BackupUpload used(folder / "used", 0);
  EXPECT_EQ(used.add(0, "back"), 4U);
  for (int repetition = 0; repetition < 2; ++repetition) {
    EXPECT_EQ(abandoned.add(0, "back"), 4U);
    EXPECT_TRUE(comes_true([&] { return !std::filesystem::exists(abandoned.file()); }));
  }
  EXPECT_THAT(abandoned.add(4, "up").error().message, HasSubstr("no upload has begun"));
  EXPECT_EQ(used.add(4, "up"), 6U);
}

}  // namespace
}  // namespace orbwatch::app::daemon::tests
