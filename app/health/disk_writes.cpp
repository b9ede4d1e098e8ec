// SPDX-License-Identifier: Apache-2.0
#include "app/health/disk_writes.h"

#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <charconv>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>

#include "app/health/system_file.h"
#include "proc/signals/signals.h"

namespace orbwatch::app {
namespace {

namespace fs = std::filesystem;

/// Unit of the kernel's counters for disks of any sector size.
constexpr double kSectorBytes = 512;
constexpr double kMebibyteOfDisk = 1024.0 * 1024.0;
constexpr double kDay = 86400;

/// Folder in sysfs of the whole disk that has `folder`.
std::optional<fs::path> disk_of(const fs::path& sys, const fs::path& folder) {
  struct stat found {};
  if (::stat(folder.c_str(), &found) != 0) return std::nullopt;
  const std::string number =
      std::to_string(major(found.st_dev)) + ":" + std::to_string(minor(found.st_dev));
  std::error_code error;
  const fs::path device = fs::canonical(sys / "dev/block" / number, error);
  if (error) return std::nullopt;
  return fs::exists(device / "partition", error) ? device.parent_path() : device;
}

/// Sectors written since power-on: the seventh column of a disk's `stat`.
std::optional<double> written_sectors(const fs::path& disk) {
  std::istringstream columns(read_system_file(disk / "stat").value_or(""));
  constexpr int kColumn = 7;
  std::string word;
  for (int column = 0; column < kColumn; ++column) {
    if (!(columns >> word)) return std::nullopt;
  }
  const auto sectors = to_integer(word);
  if (!sectors || *sectors < 0) return std::nullopt;
  return static_cast<double>(*sectors);
}

/// Seconds since power-on.
std::optional<double> uptime(const fs::path& proc) {
  const std::string text = read_system_file(proc / "uptime").value_or("");
  double seconds = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (error != std::errc{} || end == text.data() + text.size() || *end != ' ') return std::nullopt;
  return seconds;
}

}  // namespace

double disk_written_per_day(const fs::path& sys, const fs::path& proc, const fs::path& folder) {
  const auto seconds = uptime(proc);
  if (!seconds || !(*seconds >= kShortestUptime)) return signals::kNotValid;
  const auto disk = disk_of(sys, folder);
  const auto sectors = disk ? written_sectors(*disk) : std::nullopt;
  if (!sectors) return signals::kNotValid;
  return *sectors * kSectorBytes / kMebibyteOfDisk * kDay / *seconds;
}

}  // namespace orbwatch::app
