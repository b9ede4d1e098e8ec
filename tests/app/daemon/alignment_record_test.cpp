// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/alignment_record.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <thread>
#include <vector>

#include "app/files/runtime/calibration_file.h"
#include "tests/app/files/machine_files.h"
#include "tests/support/service_user.h"

namespace orbwatch::app::daemon {
namespace {

namespace fs = std::filesystem;

class Accepted : public files::ConfigurationFile {
 protected:
  Accepted() {
    std::ofstream(folder / "site.toml") << "state_folder = \"state\"\n" << files::kValid;
    fs::create_directory(folder / "state");
  }

  files::Resolved read() const { return files::resolve(folder / "site.toml").value(); }
  std::vector<CalibrationEntry> entries() const {
    files::TextFiles files;
    return load_calibrations(file, files).value();
  }
  static CalibrationEntry outline_of(double radius) {
    CalibrationEntry entry;
    entry.method = "by hand";
    entry.quality = "stated";
    entry.alignment.cameras.push_back(
        {.camera = "a", .outline = optics::Outline{{50, 40}, radius, radius, 0}});
    return entry;
  }

  const fs::path file = files::calibration_file(folder / "state");
};

TEST_F(Accepted, AreForTheRigThatRunsWhateverItsFileSays) {
  const files::Resolved running = read();
  AlignmentRecord accepted(running);
  ASSERT_TRUE(accepted.add(outline_of(31)));
  std::ofstream(folder / "rig.toml") << files::kRig << "# edited\n";
  ASSERT_TRUE(accepted.add(outline_of(32)));
  EXPECT_EQ(entries().back().rig, running.rig_checksum);
  EXPECT_TRUE(read().alignments.empty()) << "none is for the rig of now";
  const auto before = accepted.before("a");
  ASSERT_TRUE(before && *before);
  EXPECT_EQ(camera_of(**before).outline->rx, 31);
}

TEST_F(Accepted, AreNotLostWhereOthersChangeThemAtTheSameTime) {
  const files::Resolved running = read();
  constexpr int kEach = 25;
  constexpr int kWriters = 4;
  std::vector<std::thread> writers;
  for (int n = 0; n < kWriters; ++n) {
    writers.emplace_back([&] {
      AlignmentRecord accepted(running);
      for (int k = 0; k < kEach; ++k) EXPECT_TRUE(accepted.add(outline_of(31)));
    });
  }
  for (std::thread& writer : writers) writer.join();
  const auto all = entries();
  ASSERT_EQ(all.size(), kWriters * kEach);
  for (std::size_t n = 0; n < all.size(); ++n) EXPECT_EQ(all[n].number, n + 1);
}

/// Programs of earlier versions that root ran left such a file.
TEST_F(Accepted, AreKeptAsideWhereTheServiceMayNotReadThem) {
  ORBWATCH_WITHOUT_ROOT_SKIPPED();
  const files::Resolved running = read();
  ASSERT_TRUE(AlignmentRecord(running).add(outline_of(31)));
  const files::Resolved with_it = read();
  orbwatch::tests::give_to_service(folder.path());
  orbwatch::tests::give_to_service(folder / "state");
  fs::permissions(file, fs::perms(0600));  // root's
  fs::remove(file.string() + ".lock");
  EXPECT_EQ(orbwatch::tests::as_service(
                0027, [&] { return AlignmentRecord(with_it).add(outline_of(32)).has_value(); }),
            true);
  const auto all = entries();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(camera_of(all[0]).outline->rx, 31) << "that of the alignments that run";
  EXPECT_TRUE(fs::exists(file.string() + ".damaged-1"));
}

}  // namespace
}  // namespace orbwatch::app::daemon
