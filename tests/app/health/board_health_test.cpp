// SPDX-License-Identifier: Apache-2.0
#include "app/health/board_health.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/sysinfo.h>

#include <cstring>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "hal/thread/file_descriptor.h"
#include "tests/app/health/made_up_tree.h"

namespace orbwatch::app {
namespace {

using signals::is_valid;
using tests::MadeUpTree;

/// Small board in good health.
class BoardHealthTest : public testing::Test {
 protected:
  BoardHealthTest() {
    tree.write("sys/class/thermal/thermal_zone0/temp", "48312\n");
    tree.write("sys/bus/platform/devices/soc:firmware/get_throttled", "0\n");
    tree.write("sys/devices/system/cpu/cpufreq/policy0/scaling_cur_freq", "1800000\n");
    tree.write("proc/stat", "cpu  100 0 100 800 0 0 0 0 0 0\ncpu0 1 2 3 4\n");
    tree.write("proc/meminfo",
               "MemTotal: 4000000 kB\nMemAvailable:    2097152 kB\nBuffers: 1 kB\n");
    tree.write("proc/self/status", "Name:\torbwatchd\nVmPeak:\t 99 kB\nVmRSS:\t   51712 kB\n");
    tree.write("proc/self/fd/0", "");
    tree.write("proc/self/fd/1", "");
  }

  BoardHealth board() const { return BoardHealth({tree / "sys", tree / "proc", tree.path()}); }
  double temperature() const { return board().read().board_temperature; }

  MadeUpTree tree;
};

TEST_F(BoardHealthTest, ReadsWhatTheKernelShows) {
  const Health health = board().read();
  EXPECT_DOUBLE_EQ(health.board_temperature, 48.312);
  EXPECT_EQ(health.throttling, 0);
  EXPECT_EQ(health.processor_frequency, 1800);
  EXPECT_EQ(health.memory_available, 2048);
  EXPECT_EQ(health.resident_memory, 50.5);
  EXPECT_EQ(health.open_descriptors, 2);
}

TEST_F(BoardHealthTest, TakesTheHottestZoneThatMakesSense) {
  tree.write("sys/class/thermal/thermal_zone1/temp", "61000\n");
  tree.write("sys/class/thermal/thermal_zone2/temp", "-274000\n");
  tree.write("sys/class/thermal/thermal_zone3/temp", "2147483647\n");
  tree.write("sys/class/thermal/thermal_zone4/temp", "hot\n");
  tree.write("sys/class/thermal/thermal_zone5/temp", "");
  tree.make_folder("sys/class/thermal/thermal_zone6/temp");
  tree.write("sys/class/thermal/cooling_device0/temp", "90000\n");
  EXPECT_EQ(temperature(), 61);
  tree.remove("sys/class/thermal/thermal_zone1");
  EXPECT_DOUBLE_EQ(temperature(), 48.312);
  tree.write("sys/class/thermal/thermal_zone0/temp", "-5000\n");
  EXPECT_EQ(temperature(), -5) << "a cold cabinet";
  tree.remove("sys/class/thermal/thermal_zone0");
  EXPECT_FALSE(is_valid(temperature()));
}

TEST_F(BoardHealthTest, TakesTheFastestProcessor) {
  tree.write("sys/devices/system/cpu/cpufreq/policy4/scaling_cur_freq", "2400000\n");
  EXPECT_EQ(board().read().processor_frequency, 2400);
}

TEST_F(BoardHealthTest, LoadIsTheShareOfTheTimeBetweenTwoReadings) {
  BoardHealth health = board();
  EXPECT_FALSE(is_valid(health.read().processor_load)) << "there is no time before the first one";
  tree.write("proc/stat", "cpu  120 5 110 850 5 4 3 3 7 7\n");
  EXPECT_DOUBLE_EQ(health.read().processor_load, 45) << "guests are counted in user and nice";
  EXPECT_FALSE(is_valid(health.read().processor_load)) << "no time has passed";
  tree.write("proc/stat", "cpu  1 1 1 1 1 1 1 1 1 1\n");
  EXPECT_FALSE(is_valid(health.read().processor_load)) << "time went back";
  tree.write("proc/stat", "cpu  1 1 1 101 1 1 1 1 1 1\n");
  EXPECT_EQ(health.read().processor_load, 0);
  for (const std::string text : {"", "cpu", "cpu 1 2 3", "cpu 1 2 3 4 5 6 7 -8", "cpu a b c d e f",
                                 "cpu0 1 1 1 301 1 1 1 1\n"}) {
    tree.write("proc/stat", text);
    EXPECT_FALSE(is_valid(health.read().processor_load)) << text;
  }
}

TEST_F(BoardHealthTest, MemoryThatIsNotANumberIsNotValid) {
  for (const std::string text :
       {"", "MemAvailable:", "MemAvailable: kB", "MemAvailable: 12", "MemAvailable: 1 2 kB",
        "MemAvailable: -1 kB", "MemAvailable: 99999999999999999999 kB", "XMemAvailable: 1 kB"}) {
    tree.write("proc/meminfo", text);
    EXPECT_FALSE(is_valid(board().read().memory_available)) << text;
  }
}

TEST_F(BoardHealthTest, KnowsNothingWithoutItsSources) {
  const Health health = BoardHealth({tree / "no", tree / "no", tree / "no"}).read();
  const std::set<std::string_view> of_the_kernel{"clock_synchronised", "clock_estimated_error",
                                                 "clock_maximum_error"};
  for (const HealthField& figure : kHealthFigures) {
    if (of_the_kernel.contains(figure.name)) continue;
    EXPECT_FALSE(is_valid(health.*figure.get)) << figure.name;
  }
}

/// For any contents of the files, a figure is either not valid or within its range.
TEST_F(BoardHealthTest, BelievesNothingThatCannotBe) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(tree.path())) {
    if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(tree.path()));
  }
  std::mt19937 random(3);
  const std::vector<std::string> words{
      "cpu", "MemAvailable:", "VmRSS:", " kB", "\n",  " ",  "-",
      "9",   "99999",         "0x",     "nan", "1e9", "\t", "9223372036854775807"};
  BoardHealth health = board();
  std::set<std::string_view> seen_valid;
  for (int round = 0; round < 300; ++round) {
    std::string text = round % 3 == 0 ? "cpu " : round % 3 == 1 ? "VmRSS: " : "";
    for (auto count = random() % 12; count > 0; --count) text += words[random() % words.size()];
    if (round % 50 == 49) text.assign(100000, static_cast<char>(random()));
    for (const auto& file : files) tree.write(file.string(), text);
    const Health read = health.read();
    for (const HealthField& figure : kHealthFigures) {
      const double value = read.*figure.get;
      if (!is_valid(value)) continue;
      seen_valid.insert(figure.name);
      ASSERT_GE(value, figure.minimum) << figure.name << " of " << text;
      ASSERT_LE(value, figure.maximum) << figure.name << " of " << text;
    }
  }
  EXPECT_TRUE(seen_valid.contains("board_temperature")) << "some garbage is a number";
}

TEST_F(BoardHealthTest, EndlessAndUnreadableFilesAreNotValid) {
  const std::string temperature_file = "sys/class/thermal/thermal_zone0/temp";
  for (const char* device : {"/dev/zero", "/dev/urandom", "/dev/null"}) {
    tree.link(temperature_file, device);
    tree.link("proc/stat", device);
    tree.link("proc/meminfo", device);
    const Health health = board().read();
    EXPECT_FALSE(is_valid(health.board_temperature)) << device;
    EXPECT_FALSE(is_valid(health.memory_available)) << device;
  }
}

TEST_F(BoardHealthTest, DiskIsThatOfItsFolder) {
  const Health health = board().read();
  const auto space = std::filesystem::space(tree.path());
  const double capacity = static_cast<double>(space.capacity);
  EXPECT_NEAR(health.disk_free_share, 100 * static_cast<double>(space.available) / capacity, 5);
  EXPECT_NEAR(health.disk_free * 1024 * 1024 / capacity, health.disk_free_share / 100, 1e-3);
  const Health none = BoardHealth({tree / "sys", tree / "proc", "/proc"}).read();
  EXPECT_FALSE(is_valid(none.disk_free)) << "a file system without blocks has no space";
  EXPECT_FALSE(is_valid(none.disk_free_share));
}

/// Counted one by one.
int descriptors_of_this_process() {
  int count = 0;
  for (int number = 0; number < 4096; ++number) count += ::fcntl(number, F_GETFD) != -1 ? 1 : 0;
  return count;
}

TEST(BoardHealthOfThisMachine, CountsTheDescriptorsThatThisProcessHasOpen) {
  BoardHealth health({"/sys", "/proc", "/"});
  const double before = health.read().open_descriptors;
  EXPECT_EQ(before, descriptors_of_this_process());
  std::vector<hal::FileDescriptor> more;
  for (int i = 0; i < 10; ++i) more.emplace_back(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  EXPECT_EQ(health.read().open_descriptors, before + 10);
  more.clear();
  EXPECT_EQ(health.read().open_descriptors, before) << "reading leaves nothing open";
}

TEST(BoardHealthOfThisMachine, SeesTheMemoryThatThisProcessTakes) {
  BoardHealth health({"/sys", "/proc", "/"});
  const double before = health.read().resident_memory;
  // Pages of its own: the heap may give memory that is resident since other tests.
  constexpr std::size_t kBytes = std::size_t{64} << 20;
  void* const pages =
      ::mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(pages, MAP_FAILED);
  std::memset(pages, 1, kBytes);
  const double rise = health.read().resident_memory - before;
  EXPECT_EQ(static_cast<const char*>(pages)[kBytes - 1], 1);
  ::munmap(pages, kBytes);
  EXPECT_GE(rise, 60);
  EXPECT_LE(rise, 10 * 64) << "sanitizers keep books on it, but no more than that";
}

TEST(BoardHealthOfThisMachine, AvailableMemoryIsPartOfAll) {
  struct sysinfo all {};
  ASSERT_EQ(sysinfo(&all), 0);
  const double available = BoardHealth({"/sys", "/proc", "/"}).read().memory_available;
  EXPECT_GT(available, 0);
  EXPECT_LE(available, static_cast<double>(all.totalram) * all.mem_unit / 1024 / 1024);
}

Health clock(int state, int status, long estimated, long maximum) {
  timex kernel{};
  kernel.status = status;
  kernel.esterror = estimated;
  kernel.maxerror = maximum;
  Health health;
  note_clock(state, kernel, health);
  return health;
}

TEST(ClockHealth, IsWhatTheKernelSays) {
  const Health good = clock(TIME_OK, STA_PLL, 250, 16500);
  EXPECT_EQ(good.clock_synchronised, 1);
  EXPECT_EQ(good.clock_estimated_error, 0.25);
  EXPECT_EQ(good.clock_maximum_error, 16.5);
}

TEST(ClockHealth, HasNoErrorWhenNobodySetsIt) {
  const Health free_running = clock(TIME_ERROR, STA_UNSYNC, 16000000, 16000000);
  EXPECT_EQ(free_running.clock_synchronised, 0);
  EXPECT_FALSE(is_valid(free_running.clock_estimated_error));
  EXPECT_FALSE(is_valid(free_running.clock_maximum_error));
}

TEST(ClockHealth, IsNotValidWhenTheKernelDoesNotAnswer) {
  EXPECT_FALSE(is_valid(clock(-1, 0, 0, 0).clock_synchronised));
}

TEST(ClockHealth, IsReadFromTheKernel) {
  timex kernel{};
  const int state = adjtimex(&kernel);
  const Health health = BoardHealth({"/sys", "/proc", "/"}).read();
  ASSERT_EQ(is_valid(health.clock_synchronised), state >= 0);
  if (state >= 0) {
    EXPECT_EQ(health.clock_synchronised, (kernel.status & STA_UNSYNC) == 0 ? 1 : 0);
  }
}

TEST(HealthList, HasDistinctNamesAndRangesThatFitARegister) {
  std::set<std::string_view> names;
  for (const HealthField& figure : kHealthFigures) {
    EXPECT_TRUE(names.insert(figure.name).second) << figure.name;
    EXPECT_LT(figure.minimum, figure.maximum) << figure.name;
    EXPECT_LT(figure.maximum / figure.scale, 2147483647.0) << figure.name;
    EXPECT_GT(figure.minimum / figure.scale, -2147483648.0) << figure.name;
    EXPECT_FALSE(figure.description.empty()) << figure.name;
  }
}

}  // namespace
}  // namespace orbwatch::app
