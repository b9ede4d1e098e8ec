// SPDX-License-Identifier: Apache-2.0
#include "app/health/board_health.h"

#include <sys/statvfs.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "app/health/disk_writes.h"
#include "app/health/system_file.h"
#include "hal/synchronised_clock.h"

namespace orbwatch::app {
namespace {

namespace fs = std::filesystem;
using signals::kNotValid;

constexpr double kMebibyte = 1024.0 * 1024.0;

/// The larger of two values, of which the first may be invalid.
double larger(double a, double b) { return signals::is_valid(a) ? std::max(a, b) : b; }

bool is_within(const HealthField& figure, double value) {
  return value >= figure.minimum && value <= figure.maximum;
}

constexpr const HealthField& info_of(double Health::*member) {
  return *std::find_if(kHealthFigures.begin(), kHealthFigures.end(),
                       [member](const HealthField& figure) { return figure.get == member; });
}

/// Zones without a sensor report arbitrary values, so each one is checked.
double board_temperature(const fs::path& sys) {
  double hottest = kNotValid;
  for (const fs::path& zone : entries(sys / "class/thermal", "thermal_zone")) {
    const auto thousandths = read_integer(zone / "temp");
    if (!thousandths) continue;
    const double celsius = static_cast<double>(*thousandths) / 1000;
    if (is_within(info_of(&Health::board_temperature), celsius)) hottest = larger(hottest, celsius);
  }
  return hottest;
}

double processor_frequency(const fs::path& sys) {
  double fastest = kNotValid;
  for (const fs::path& policy : entries(sys / "devices/system/cpu/cpufreq", "policy")) {
    const auto kilohertz = read_integer(policy / "scaling_cur_freq");
    if (kilohertz) fastest = larger(fastest, static_cast<double>(*kilohertz) / 1000);
  }
  return fastest;
}

/// Value of a line of memory_line(), MiB.
double memory_line_mib(const fs::path& file, std::string_view key) {
  const auto bytes = memory_line(file, key);
  return bytes ? static_cast<double>(*bytes) / (1 << 20) : kNotValid;
}

double open_descriptors(const fs::path& proc) {
  std::size_t count = 0;
  std::error_code error;
  for (const fs::path& descriptor : entries(proc / "self/fd")) {
    // The listing's own descriptor is closed by now.
    count += fs::exists(fs::symlink_status(descriptor, error)) ? 1 : 0;
  }
  return count > 0 ? static_cast<double>(count) : kNotValid;  // 0: not listable
}

void note_disk(const fs::path& folder, Health& health) {
  struct statvfs disk {};
  if (::statvfs(folder.c_str(), &disk) != 0 || disk.f_blocks == 0) return;
  const double free = static_cast<double>(disk.f_bavail);
  health.disk_free = free * static_cast<double>(disk.f_frsize) / kMebibyte;
  health.disk_free_share = 100 * free / static_cast<double>(disk.f_blocks);
}

}  // namespace

BoardHealth::BoardHealth(HealthSources sources)
    : sources_(std::move(sources)), throttling_(sources_.sys) {}

Health BoardHealth::read() {
  Health health;
  health.board_temperature = board_temperature(sources_.sys);
  if (const auto bits = throttling_.read()) health.throttling = *bits;
  health.processor_load = processor_load();
  health.processor_frequency = processor_frequency(sources_.sys);
  health.memory_available = memory_line_mib(sources_.proc / "meminfo", "MemAvailable:");
  note_disk(sources_.disk, health);
  health.disk_written_per_day = disk_written_per_day(sources_.sys, sources_.proc, sources_.disk);
  timex clock{};
  note_clock(::adjtimex(&clock), clock, health);
  health.resident_memory = memory_line_mib(sources_.proc / "self/status", "VmRSS:");
  health.open_descriptors = open_descriptors(sources_.proc);
  for (const HealthField& figure : kHealthFigures) {
    double& value = health.*figure.get;
    if (!is_within(figure, value)) value = kNotValid;
  }
  return health;
}

/// Processor time from the first line of /proc/stat: "cpu" and the ticks as user, nice, system,
/// idle, iowait, irq, softirq and steal; the other columns are included in the first two.
std::optional<BoardHealth::ProcessorTime> BoardHealth::processor_time(const fs::path& proc) {
  const std::string text = read_system_file(proc / "stat").value_or("");
  std::istringstream line(text.substr(0, text.find('\n')));
  std::string word;
  if (!(line >> word) || word != "cpu") return std::nullopt;
  std::array<double, 8> ticks{};
  for (double& tick : ticks) {
    if (!(line >> word)) return std::nullopt;
    const auto count = to_integer(word);
    if (!count || *count < 0) return std::nullopt;
    tick = static_cast<double>(*count);
  }
  ProcessorTime time{ticks[3] + ticks[4], 0};
  for (const double tick : ticks) time.total += tick;
  return time;
}

double BoardHealth::processor_load() {
  const auto before = std::exchange(processor_time_, processor_time(sources_.proc));
  if (!before || !processor_time_) return kNotValid;
  const double passed = processor_time_->total - before->total;
  return passed > 0 ? 100 * (1 - (processor_time_->idle - before->idle) / passed) : kNotValid;
}

void note_clock(int state, const timex& clock, Health& health) {
  if (state < 0) return;
  const bool synchronised = hal::is_synchronised(clock);
  health.clock_synchronised = synchronised ? 1 : 0;
  if (!synchronised) return;
  health.clock_estimated_error = static_cast<double>(clock.esterror) / 1000;
  health.clock_maximum_error = static_cast<double>(clock.maxerror) / 1000;
}

}  // namespace orbwatch::app
