// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <random>
#include <thread>

#include "app/files/runtime/calibration_file.h"
#include "app/files/runtime/trial.h"
#include "hal/atomic_file.h"
#include "tests/app/files/machine_files.h"
#include "tests/support/share.h"

/// SIGKILL at any moment of a write: the file is then the old or the new one, and valid.
namespace orbwatch::app::files {
namespace {

namespace fs = std::filesystem;
using std::chrono::microseconds;

constexpr int kKills = 1000;

/// Runs `work` repeatedly in a process of its own, and kills it after `time`.
void kill_amid(const std::function<bool()>& work, microseconds time) {
  int begun[2];
  ASSERT_EQ(::pipe(begun), 0);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const bool is_told = ::write(begun[1], "b", 1) == 1;
    while (is_told && work()) {
    }
    ::_exit(1);
  }
  char byte = 0;
  EXPECT_EQ(::read(begun[0], &byte, 1), 1);
  std::this_thread::sleep_for(time);  // the random moment
  ::kill(child, SIGKILL);
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status)) << "it could not write";
  for (const int end : begun) ::close(end);
}

class KilledWriter : public ConfigurationFile {
 protected:
  /// Duration of one round of `work` at the machine's present load.
  static microseconds time_of(const std::function<bool()>& work) {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_TRUE(work());
    return std::chrono::duration_cast<microseconds>(std::chrono::steady_clock::now() - begin);
  }
  void kill_often(const std::function<bool()>& work, const std::function<void()>& judge) {
    constexpr int kLoadLasts = 10;  // kills
    long longest = 0;
    for (int n = 0; n < tests::share_of(kKills) && !HasFailure(); ++n) {
      if (n % kLoadLasts == 0) longest = 2 * time_of(work).count();
      kill_amid(work, microseconds(std::uniform_int_distribution<long>(0, longest)(random_)));
      judge();
    }
  }
  std::string contents(const fs::path& file) const {
    TextFiles files;
    return files.read(file, "a file").value_or("there is none");
  }

  std::mt19937 random_{20261125};
};

/// Site and rig only fit each other: the camera's name changes in both.
TEST_F(KilledWriter, OfAConfigurationLeavesTheOldOrTheNewOne) {
  const fs::path site = folder / "site.toml", rig = folder / "rig.toml", state = folder / "state";
  fs::create_directory(state);
  const auto texts = [&](const std::string& name) {
    const std::string is = "name = \"" + name + "\"";
    return FileTexts{{site, "# by hand\n" + replaced("camera = \"a\"", "camera = \"" + name + "\"",
                                                     replaced("name = \"a\"", is))},
                     {rig, replaced("name = \"a\"", is, kRig) + "# the end"}};
  };
  const FileTexts one = texts("a"), other = texts("b");
  for (const auto& [file, text] : one) ASSERT_TRUE(hal::write_file(file, text));
  const auto change = [&] {
    const FileTexts& next = contents(site) == one.at(site) ? other : one;
    return request_trial(state, {site, next, 60}) && take_trial(state) && confirm_trial(state);
  };
  int amid = 0, ones = 0;
  kill_often(change, [&] {
    const auto finished = finish_confirmed(state);  // orbwatchd does this when it starts
    ASSERT_TRUE(finished) << finished.error().message;
    amid += *finished ? 1 : 0;
    end_trial(state);
    const bool is_one = contents(site) == one.at(site);
    ones += is_one ? 1 : 0;
    for (const auto& [file, text] : is_one ? one : other) EXPECT_EQ(contents(file), text);
    const auto resolved = resolve(site);
    EXPECT_TRUE(resolved) << resolved.error().message;
  });
  RecordProperty("killed_amid_the_files", amid);
  EXPECT_GT(amid, 0) << "no kill hit what is between two files";
  EXPECT_GT(ones, 0);
  ASSERT_TRUE(hal::remove_unfinished(folder.path()));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 4) << "nothing is left over";
}

TEST_F(KilledWriter, OfAlignmentsLeavesTheOldOrTheNewOnes) {
  const fs::path file = calibration_file(folder.path());
  std::vector<CalibrationEntry> entries;
  CalibrationEntry entry;
  entry.method = "by hand";
  entry.alignment.cameras.push_back(
      {.camera = "a", .outline = optics::Outline{{50, 40}, 30, 30, 0}});
  for (int n = 0; n < 50; ++n) accept(entries, entry);
  const std::vector<CalibrationEntry> more(entries.begin(), entries.end() - 1);
  ASSERT_TRUE(save_calibrations(file, entries));
  const auto count = [&]() -> std::size_t {
    TextFiles files;
    const auto read = load_calibrations(file, files);
    EXPECT_TRUE(read) << read.error().message;
    return read ? read->size() : 0;
  };
  const auto change = [&] {
    return save_calibrations(file, count() == entries.size() ? more : entries).has_value();
  };
  std::size_t old = 0, young = 0;
  kill_often(change, [&] {
    const std::size_t now = count();
    EXPECT_TRUE(now == entries.size() || now == more.size()) << now;
    ++(now == entries.size() ? old : young);
  });
  EXPECT_GT(old, 0U);
  EXPECT_GT(young, 0U);
}

}  // namespace
}  // namespace orbwatch::app::files
