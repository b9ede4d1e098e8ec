// SPDX-License-Identifier: Apache-2.0
#include "app/files/text/file_version.h"

#include <pwd.h>
#include <sys/stat.h>

#include <array>
#include <chrono>

#include "app/files/text/text_file.h"
#include "app/model/status/utc_text.h"
#include "hal/regular_file.h"

namespace orbwatch::app::files {
namespace {

/// Name of an account; its number if the name is unknown.
std::string account_name(uid_t id) {
  std::array<char, 4096> texts{};
  passwd entry{};
  passwd* found = nullptr;
  const int error = ::getpwuid_r(id, &entry, texts.data(), texts.size(), &found);
  return error == 0 && found != nullptr ? found->pw_name : "user " + std::to_string(id);
}

/// Removes the fraction of "2026-11-21T20:57:46.123456789Z".
std::string to_the_second(const std::string& utc) {
  const auto point = utc.find('.');
  return point == std::string::npos ? utc : utc.substr(0, point) + "Z";
}

}  // namespace

FileVersion version_of(const std::filesystem::path& file) {
  FileVersion version;
  if (const auto text = hal::read_regular_file(file)) version.checksum = checksum_of(*text);
  struct stat about {};
  if (::stat(file.c_str(), &about) != 0) return version;
  using std::chrono::system_clock;
  const auto age =
      std::chrono::seconds(about.st_mtim.tv_sec) + std::chrono::nanoseconds(about.st_mtim.tv_nsec);
  version.time = to_the_second(
      utc_text(system_clock::time_point(std::chrono::duration_cast<system_clock::duration>(age)))
          .value_or(""));
  version.account = account_name(about.st_uid);
  return version;
}

std::string change_text(const std::string& name, const FileVersion& now) {
  if (now.time.empty()) return name + " was removed";
  return name + " was changed by " + now.account + " at " + now.time;
}

}  // namespace orbwatch::app::files
