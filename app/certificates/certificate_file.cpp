// SPDX-License-Identifier: Apache-2.0
#include "app/certificates/certificate_file.h"

#include <sys/stat.h>

#include "hal/regular_file.h"

namespace orbwatch::app {
namespace {

namespace fs = std::filesystem;

std::string day(std::chrono::sys_seconds time) { return date_text(time, "%Y-%m-%d %H:%M UTC"); }

}  // namespace

Result<> check_dates(const fs::path& file, const ValidityPeriod& validity, const Now& now) {
  if (!now) return {};
  if (now >= validity.until) {
    return fail(file.string() + ": expired on " + day(validity.until) + "; it must be renewed");
  }
  if (now < validity.from) {
    return fail(file.string() + ": is valid from " + day(validity.from) +
                " on; check this computer's clock, which reads " + day(*now));
  }
  return {};
}

Result<> check_dates(const fs::path& file, const Certificate& certificate, const Now& now) {
  return of_file(file, validity_of(certificate)).and_then([&](const ValidityPeriod& validity) {
    return check_dates(file, validity, now);
  });
}

Result<Certificate> read_certificate(const fs::path& file) {
  return hal::read_regular_file(file).and_then(
      [&](const std::string& pem) { return of_file(file, certificate_from_pem(pem)); });
}

Result<Key> read_key(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
      (status.st_mode & S_IROTH) != 0) {
    return fail(file.string() + ": is world-readable; set its mode to 0600 by chmod");
  }
  return hal::read_regular_file(file).and_then(
      [&](const std::string& pem) { return of_file(file, key_from_pem(pem)); });
}

Result<> check_pair(const fs::path& key_file, const Key& key, const fs::path& certificate_file,
                    const Certificate& certificate) {
  if (is_key_of(key, certificate)) return {};
  return fail(key_file.string() + ": is not the key of " + certificate_file.string());
}

}  // namespace orbwatch::app
