// SPDX-License-Identifier: Apache-2.0
#include "app/health/throttling.h"

#include <string>

#include "app/health/system_file.h"

namespace orbwatch::app {
namespace {

namespace fs = std::filesystem;

constexpr unsigned bit(Throttling throttling) { return static_cast<unsigned>(throttling); }

struct Bits {
  unsigned now = 0;
  unsigned before = 0;
};

/// Bits of the firmware: current causes in bits 0 to 3, past ones in 16 to 19.
std::optional<Bits> of_firmware(const fs::path& sys) {
  for (const fs::path& device : entries(sys / "bus/platform/devices")) {
    if (!device.native().ends_with(":firmware")) continue;
    const auto word = read_integer(device / "get_throttled", 16);
    if (!word || *word < 0 || *word > UINT32_MAX) continue;
    const auto bits = static_cast<std::uint32_t>(*word);
    return Bits{bits & 0xf, (bits >> 16) & 0xf};
  }
  return std::nullopt;
}

/// Supply monitor of the same chip, also in kernels without that word.
std::optional<Bits> of_supply_monitor(const fs::path& sys) {
  for (const fs::path& device : entries(sys / "class/hwmon")) {
    if (read_system_file(device / "name") != "rpi_volt\n") continue;
    const auto alarm = read_integer(device / "in0_lcrit_alarm");
    if (alarm) return Bits{*alarm != 0 ? bit(Throttling::UnderVoltage) : 0};
  }
  return std::nullopt;
}

/// State of a processor as a cooling device: 0 at full speed.
std::optional<Bits> of_cooling_devices(const fs::path& sys) {
  std::optional<Bits> bits;
  for (const fs::path& device : entries(sys / "class/thermal", "cooling_device")) {
    const std::string type = read_system_file(device / "type").value_or("");
    if (type.find("cpufreq") == std::string::npos && type != "Processor\n") continue;
    const auto state = read_integer(device / "cur_state");
    if (!state || *state < 0) continue;
    if (!bits) bits.emplace();
    if (*state > 0) bits->now = bit(Throttling::FrequencyCapped);
  }
  return bits;
}

/// Throttling events of x86 processors since power-on.
std::optional<std::int64_t> count_of_processors(const fs::path& sys) {
  std::optional<std::int64_t> sum;
  for (const fs::path& cpu : entries(sys / "devices/system/cpu", "cpu")) {
    for (const char* counter : {"core_throttle_count", "package_throttle_count"}) {
      const auto count = read_integer(cpu / "thermal_throttle" / counter);
      if (count && *count >= 0 && *count <= UINT32_MAX) sum = sum.value_or(0) + *count;
    }
  }
  return sum;
}

}  // namespace

std::optional<std::uint8_t> ThrottlingMonitor::read() {
  std::optional<Bits> all;
  const auto add = [&all](const std::optional<Bits>& bits) {
    if (!bits) return;
    if (!all) all.emplace();
    all->now |= bits->now;
    all->before |= bits->before;
  };
  add(of_firmware(sys_));
  add(of_supply_monitor(sys_));
  add(of_cooling_devices(sys_));
  if (const auto events = count_of_processors(sys_)) {
    constexpr unsigned kThrottled = bit(Throttling::Throttled);
    const bool more = events_ && *events > *events_;
    add(Bits{more ? kThrottled : 0, *events > 0 ? kThrottled : 0});
    events_ = events;
  }
  if (!all) return std::nullopt;
  since_power_on_ |= all->now | all->before;
  return static_cast<std::uint8_t>(all->now | since_power_on_ << kSincePowerOn);
}

}  // namespace orbwatch::app
