// SPDX-License-Identifier: Apache-2.0
#include "app/files/runtime/calibration_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "app/files/resolve.h"
#include "app/files/rig/rig_file.h"
#include "tests/app/files/machine_files.h"

namespace orbwatch::app::files {
namespace {

constexpr std::uint32_t kThisRig = 4'000'000'001;

CalibrationEntry outline_of(const std::string& camera, double radius) {
  CalibrationEntry entry;
  entry.method = "register: \"light\"";
  entry.quality = "0.3 deg rms";
  entry.rig = kThisRig;
  entry.alignment.cameras.push_back(
      {.camera = camera,
       .outline = optics::Outline{{50.25, 40}, radius, radius - 0.5, 12},
       .registration = optics::rotation({10, -20, 30})});
  return entry;
}

std::vector<CalibrationEntry> some() {
  std::vector<CalibrationEntry> entries;
  accept(entries, outline_of("a", 30));
  accept(entries, outline_of("spare", 90));
  accept(entries, outline_of("a", 31));
  entries[1].alignment.ball_centre = optics::Vec3{1, 2, 3};
  return entries;
}

class CalibrationFile : public ConfigurationFile {
 protected:
  std::vector<CalibrationEntry> written(const std::vector<CalibrationEntry>& entries) {
    const auto file = calibration_file(folder.path());
    EXPECT_TRUE(save_calibrations(file, entries));
    TextFiles files;
    const auto read = load_calibrations(file, files);
    EXPECT_TRUE(read) << read.error().message;
    return read.value_or(std::vector<CalibrationEntry>{});
  }
};

TEST_F(CalibrationFile, IsReadAsItWasWritten) {
  const auto entries = some();
  const auto read = written(entries);
  ASSERT_EQ(read.size(), 3U);
  EXPECT_EQ(read[2].number, 3);
  EXPECT_EQ(read[2].time, entries[2].time);
  EXPECT_EQ(read[2].method, entries[2].method);
  EXPECT_EQ(read[2].rig, kThisRig);
  const CameraAlignment& a = read[2].alignment.cameras.front();
  EXPECT_EQ(a.camera, "a");
  EXPECT_EQ(a.outline->rx, 31);
  EXPECT_EQ(a.outline->ry, 30.5);
  EXPECT_NEAR(a.registration->row0.y, optics::rotation({10, -20, 30}).row0.y, 1e-9);
  EXPECT_EQ(read[1].alignment.ball_centre->z, 3);
  EXPECT_FALSE(read[0].alignment.ball_centre);
}

TEST_F(CalibrationFile, KeepsAPoseAndItsLens) {
  CalibrationEntry entry = outline_of("a", 30);
  entry.alignment.cameras.front() = {
      .camera = "a",
      .pose = optics::Pose{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {1, 2, 3}},
      .intrinsics = optics::Intrinsics{100, 80, 500, 501, 49.5, 39.5}};
  std::vector<CalibrationEntry> entries;
  accept(entries, entry);
  const auto read = written(entries);
  ASSERT_EQ(read.size(), 1U);
  const CameraAlignment& a = read[0].alignment.cameras.front();
  EXPECT_EQ(a.pose->position.y, 2);
  EXPECT_FALSE(a.outline);
  EXPECT_EQ(a.intrinsics->fy, 501);
}

TEST_F(CalibrationFile, KeepsEveryDamagedOneBesideIt) {
  const auto file = calibration_file(folder.path());
  for (const std::string text : {"first", "second"}) {
    std::ofstream(file) << text;
    const auto kept = keep_damaged(file);
    ASSERT_TRUE(kept) << kept.error().message;
    EXPECT_EQ(*kept, file.string() + (text == "first" ? ".damaged-1" : ".damaged-2"));
    ASSERT_TRUE(save_calibrations(file, some()));
    std::ifstream in(*kept);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), text);
  }
  EXPECT_FALSE(keep_damaged(folder.path() / "none.toml"));
}

TEST_F(CalibrationFile, IsEmptyWhenItDoesNotExist) {
  TextFiles files;
  const auto read = load_calibrations(folder.path() / "none.toml", files);
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->empty());
}

TEST_F(CalibrationFile, KeepsTheNewestEntriesOnly) {
  std::vector<CalibrationEntry> entries;
  for (std::size_t n = 0; n < kMaxCalibrations + 5; ++n) accept(entries, outline_of("a", 30));
  const auto read = written(entries);
  ASSERT_EQ(read.size(), kMaxCalibrations);
  EXPECT_EQ(read.front().number, 6);
}

TEST_F(CalibrationFile, OfEachCameraTheNewestEntryCounts) {
  const auto current = in_force(some(), kThisRig);
  ASSERT_EQ(current.size(), 2U);
  EXPECT_EQ(current[0].number, 2);
  EXPECT_EQ(current[1].number, 3);
  EXPECT_TRUE(in_force(some(), kThisRig + 1).empty()) << "another rig file";
}

TEST_F(CalibrationFile, ReplacesWhatTheRigSays) {
  auto rig = parse_rig(kRig, "rig.toml", ".");
  ASSERT_TRUE(rig);
  ASSERT_TRUE(apply(outline_of("a", 31).alignment, *rig));
  EXPECT_EQ(rig->cameras[0].outline->rx, 31);
  EXPECT_EQ(rig->cameras[0].alpha, 340);
  EXPECT_EQ(rig->cameras[1].outline->rx, 90);
  RigAlignment impossible = outline_of("a", -1).alignment;
  EXPECT_FALSE(apply(impossible, *rig));
}

TEST_F(CalibrationFile, IsInForceWhenTheSiteIsResolved) {
  std::ofstream(folder / "site.toml") << "state_folder = \"state\"\n" << kValid;
  std::filesystem::create_directory(folder / "state");
  const auto plain = resolve(folder / "site.toml");
  ASSERT_TRUE(plain) << plain.error().message;
  CalibrationEntry entry = outline_of("a", 31);
  entry.rig = *rig_checksum(folder / "rig.toml");
  std::vector<CalibrationEntry> entries;
  accept(entries, entry);
  ASSERT_TRUE(save_calibrations(calibration_file(folder / "state"), entries));
  const auto aligned = resolve(folder / "site.toml");
  ASSERT_TRUE(aligned) << aligned.error().message;
  EXPECT_EQ(aligned->rig.cameras[0].outline->rx, 31);
  ASSERT_EQ(aligned->alignments.size(), 1U);
  EXPECT_NE(aligned->checksum, plain->checksum);
  std::ofstream(folder / "rig.toml", std::ios::app) << "# changed\n";
  const auto changed = resolve(folder / "site.toml");
  ASSERT_TRUE(changed);
  EXPECT_EQ(changed->rig.cameras[0].outline->rx, 30);
}

TEST_F(CalibrationFile, RefusesAFileThatItDidNotWrite) {
  std::ofstream(calibration_file(folder.path())) << "[[entry]]\nnumber = 0\n";
  TextFiles files;
  const auto read = load_calibrations(calibration_file(folder.path()), files);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("calibration.toml:2: entry.number"), std::string::npos)
      << read.error().message;
}

TEST_F(CalibrationFile, AnOutlineAloneDoesNotRegisterACamera) {
  std::vector<CalibrationEntry> entries;
  accept(entries, outline_of("a", 31));
  accept(entries, outline_of("a", 32));
  entries[0].alignment.cameras[0].registration.reset();
  const auto read = written(entries);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_FALSE(camera_of(read[0]).registration);
  EXPECT_TRUE(camera_of(read[1]).registration);
  auto rig = load_rig(folder / "rig.toml").value();
  rig.cameras[0].is_registered = false;
  ASSERT_TRUE(apply(read[0].alignment, rig));
  EXPECT_FALSE(rig.cameras[0].is_registered);
  ASSERT_TRUE(apply(read[1].alignment, rig));
  EXPECT_TRUE(rig.cameras[0].is_registered);
}

TEST_F(CalibrationFile, AnEntryForAnotherRigHidesNone) {
  std::vector<CalibrationEntry> entries = some();
  CalibrationEntry other = outline_of("a", 99);
  other.rig = kThisRig - 1;
  accept(entries, other);
  const auto counts = in_force(entries, kThisRig);
  ASSERT_EQ(counts.size(), 2U);
  EXPECT_EQ(camera_of(counts[1]).outline->rx, 31);
}

TEST_F(CalibrationFile, IsForTheRigAsItWasRead) {
  std::ofstream(folder / "site.toml") << "state_folder = \"state\"\n" << kValid;
  const auto before = resolve(folder / "site.toml");
  ASSERT_TRUE(before) << before.error().message;
  EXPECT_EQ(before->rig_checksum, rig_checksum(folder / "rig.toml").value());
  std::ofstream(folder / "rig.toml") << kRig << "# edited\n";
  EXPECT_NE(before->rig_checksum, rig_checksum(folder / "rig.toml").value());
}

}  // namespace
}  // namespace orbwatch::app::files
