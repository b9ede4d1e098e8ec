// SPDX-License-Identifier: Apache-2.0
#include "app/health/throttling.h"

#include <gtest/gtest.h>

#include "tests/app/health/made_up_tree.h"

namespace orbwatch::app {
namespace {

using tests::MadeUpTree;

constexpr int kUnderVoltage = 1;
constexpr int kCapped = 2;
constexpr int kThrottled = 4;

int before(int bits) { return bits << 4; }

constexpr const char* kFirmware = "bus/platform/devices/soc:firmware/get_throttled";
constexpr const char* kFirmwareOfPi5 = "bus/platform/devices/soc@107c000000:firmware/get_throttled";

TEST(Throttling, IsUnknownWhereNothingTells) {
  MadeUpTree sys;
  EXPECT_EQ(ThrottlingMonitor(sys.path()).read(), std::nullopt);
  EXPECT_EQ(ThrottlingMonitor("/nowhere").read(), std::nullopt);
}

TEST(Throttling, ReadsTheFirmwaresWord) {
  for (const char* file : {kFirmware, kFirmwareOfPi5}) {
    MadeUpTree sys;
    sys.write(file, "0\n");
    EXPECT_EQ(ThrottlingMonitor(sys.path()).read(), 0);
    sys.write(file, "50005\n");
    EXPECT_EQ(ThrottlingMonitor(sys.path()).read(),
              kUnderVoltage | kThrottled | before(kUnderVoltage | kThrottled));
    sys.write(file, "0x80000\n");
    EXPECT_EQ(ThrottlingMonitor(sys.path()).read(), before(8));
    sys.write(file, "f000f");
    EXPECT_EQ(ThrottlingMonitor(sys.path()).read(), 0xff);
  }
}

TEST(Throttling, RemembersWhatTheFirmwareForgets) {
  MadeUpTree sys;
  ThrottlingMonitor monitor(sys.path());
  sys.write(kFirmware, "2");
  EXPECT_EQ(monitor.read(), kCapped | before(kCapped));
  sys.write(kFirmware, "0");
  EXPECT_EQ(monitor.read(), before(kCapped));
}

TEST(Throttling, BelievesNoGarbage) {
  for (const std::string text :
       {"", "garbage", "-1", "50005 50005", "100000000", "fffffffffffffffffffff"}) {
    MadeUpTree sys;
    sys.write(kFirmware, text);
    sys.write("class/thermal/cooling_device0/type", "cpufreq-cpu0\n");
    sys.write("class/thermal/cooling_device0/cur_state", text == "50005 50005" ? "-1" : "x");
    sys.write("class/hwmon/hwmon0/name", "rpi_volt\n");
    sys.write("class/hwmon/hwmon0/in0_lcrit_alarm", "");
    sys.write("devices/system/cpu/cpu0/thermal_throttle/core_throttle_count", "-5");
    EXPECT_EQ(ThrottlingMonitor(sys.path()).read(), std::nullopt) << text;
  }
}

TEST(Throttling, AsksTheSupplyMonitorOfTheRaspberryPiOnly) {
  MadeUpTree sys;
  sys.write("class/hwmon/hwmon0/name", "other\n");
  sys.write("class/hwmon/hwmon0/in0_lcrit_alarm", "1\n");
  EXPECT_EQ(ThrottlingMonitor(sys.path()).read(), std::nullopt);
  sys.write("class/hwmon/hwmon1/name", "rpi_volt\n");
  sys.write("class/hwmon/hwmon1/in0_lcrit_alarm", "1\n");
  EXPECT_EQ(ThrottlingMonitor(sys.path()).read(), kUnderVoltage | before(kUnderVoltage));
}

TEST(Throttling, SeesProcessorsThatAreCooledDown) {
  MadeUpTree sys;
  ThrottlingMonitor monitor(sys.path());
  sys.write("class/thermal/cooling_device0/type", "pwm-fan\n");
  sys.write("class/thermal/cooling_device0/cur_state", "3\n");
  EXPECT_EQ(monitor.read(), std::nullopt) << "a fan holds nothing back";
  for (const std::string type : {"cpufreq-cpu0\n", "thermal-cpufreq-0\n", "Processor\n"}) {
    ThrottlingMonitor fresh(sys.path());
    sys.write("class/thermal/cooling_device1/type", type);
    sys.write("class/thermal/cooling_device1/cur_state", "0\n");
    EXPECT_EQ(fresh.read(), 0) << type;
    sys.write("class/thermal/cooling_device1/cur_state", "2\n");
    EXPECT_EQ(fresh.read(), kCapped | before(kCapped)) << type;
    sys.write("class/thermal/cooling_device1/cur_state", "0\n");
    EXPECT_EQ(fresh.read(), before(kCapped)) << type;
  }
}

TEST(Throttling, IsNowWhileTheProcessorsCountIt) {
  MadeUpTree sys;
  ThrottlingMonitor monitor(sys.path());
  const auto write = [&](int core, int package) {
    sys.write("devices/system/cpu/cpu0/thermal_throttle/core_throttle_count", "0\n");
    sys.write("devices/system/cpu/cpu1/thermal_throttle/core_throttle_count", std::to_string(core));
    sys.write("devices/system/cpu/cpu1/thermal_throttle/package_throttle_count",
              std::to_string(package));
  };
  write(0, 0);
  EXPECT_EQ(monitor.read(), 0);
  write(1, 0);
  EXPECT_EQ(monitor.read(), kThrottled | before(kThrottled));
  EXPECT_EQ(monitor.read(), before(kThrottled));
  write(1, 2);
  EXPECT_EQ(monitor.read(), kThrottled | before(kThrottled));
  EXPECT_EQ(ThrottlingMonitor(sys.path()).read(), before(kThrottled)) << "counted before it began";
}

TEST(Throttling, JoinsWhatItIsTold) {
  MadeUpTree sys;
  sys.write(kFirmware, "1");
  sys.write("class/thermal/cooling_device0/type", "cpufreq-cpu0\n");
  sys.write("class/thermal/cooling_device0/cur_state", "1");
  sys.write("devices/system/cpu/cpu0/thermal_throttle/core_throttle_count", "9");
  EXPECT_EQ(ThrottlingMonitor(sys.path()).read(),
            kUnderVoltage | kCapped | before(kUnderVoltage | kCapped | kThrottled));
}

}  // namespace
}  // namespace orbwatch::app
