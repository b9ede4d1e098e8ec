// SPDX-License-Identifier: Apache-2.0
#include "app/update/image_files.h"

#include <algorithm>
#include <charconv>
#include <ctime>
#include <sstream>
#include <string_view>
#include <system_error>

#include "hal/atomic_file.h"
#include "hal/boot_id.h"
#include "hal/regular_file.h"

namespace orbwatch::app::update {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestFile = 65536;

/// Two lines of a small file; empty where it has none.
struct Lines {
  std::string first, second;
};
Lines lines_of(const fs::path& file) {
  std::istringstream in(hal::read_regular_file(file, kLongestFile).value_or(""));
  Lines lines;
  std::getline(in, lines.first);
  std::getline(in, lines.second);
  return lines;
}

/// Time since the computer's start, as /proc/uptime has it.
std::chrono::seconds uptime() {
  timespec now{};
  ::clock_gettime(CLOCK_BOOTTIME, &now);
  return std::chrono::seconds(now.tv_sec);
}

/// Time until a moment that is stated as uptime; nullopt: no number.
std::optional<std::chrono::seconds> time_until(std::string_view text) {
  long long moment = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), moment);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return std::max(std::chrono::seconds(moment) - uptime(), std::chrono::seconds(0));
}

}  // namespace

std::optional<std::string> ImageFiles::version() const {
  constexpr std::string_view kId = "IMAGE_ID=orbwatch", kVersion = "IMAGE_VERSION=";
  std::istringstream in(
      hal::read_regular_file(root_ / "etc/os-release", kLongestFile).value_or(""));
  std::string version;
  bool is_image = false;
  for (std::string line; std::getline(in, line);) {
    is_image = is_image || line == kId;
    if (line.starts_with(kVersion)) version = line.substr(kVersion.size());
  }
  return is_image && !version.empty() ? std::optional(version) : std::nullopt;
}

std::string ImageFiles::slot() const { return lines_of(root_ / "run/orbwatch-image/slot").first; }

bool ImageFiles::accepts_updates() const {
  std::error_code none;
  return fs::exists(root_ / "etc/rauc/keyring.pem", none);
}

std::optional<Trial> ImageFiles::trial() const {
  const fs::path file = root_ / "run/orbwatch-image/trial";
  std::error_code none;
  if (!fs::exists(file, none)) return std::nullopt;
  const Lines lines = lines_of(file);
  return Trial{time_until(lines.first).value_or(std::chrono::seconds(0)), time_until(lines.second)};
}

fs::path ImageFiles::record() const { return root_ / "data/update/tried"; }

std::optional<Tried> ImageFiles::tried() const {
  const Lines lines = lines_of(record());
  if (lines.first.empty()) return std::nullopt;
  return Tried{lines.first, !lines.second.empty() && lines.second == hal::boot_id(root_)};
}

std::string ImageFiles::reason_of_return(const std::string& version) const {
  const Lines lines = lines_of(root_ / "data/returned");
  return lines.first == version ? lines.second : "";
}

Result<> ImageFiles::prepare_record(const std::string& version) const {
  const fs::path file = record().string() + ".new";
  std::error_code none;  // the write below fails then
  fs::create_directories(file.parent_path(), none);
  return hal::write_file(file, version + "\n" + hal::boot_id(root_) + "\n", hal::FileAccess::Folder)
      .map_error([&](const Error& error) {
        return Error{error.message + "; the data partition is full or has a fault"};
      });
}

Result<> ImageFiles::keep_record() const {
  std::error_code error;
  fs::rename(record().string() + ".new", record(), error);
  const auto kept = tried();
  const bool is_kept =
      error == std::errc::no_such_file_or_directory && kept && kept->waits_for_start;
  if (error && !is_kept) return fail(record().string() + ": " + error.message());
  return hal::sync_folder(record().parent_path());
}

}  // namespace orbwatch::app::update
