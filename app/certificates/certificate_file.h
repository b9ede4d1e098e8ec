// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "app/certificates/certificate.h"
#include "app/certificates/dates.h"
#include "proc/image/result.h"

/// Keys and certificates in PEM files named by users; errors name file and reason. All reentrant;
/// they wait for the disk.
namespace orbwatch::app {

/// Prefixes an error of `result` with the file.
template <class Value>
Result<Value> of_file(const std::filesystem::path& file, Result<Value> result) {
  if (result) return result;
  return fail(file.string() + ": " + result.error().message);
}

/// Error: `now` lies outside.
Result<> check_dates(const std::filesystem::path& file, const ValidityPeriod& validity,
                     const Now& now);
/// Checks the dates of the certificate read from `file`.
Result<> check_dates(const std::filesystem::path& file, const Certificate& certificate,
                     const Now& now);

Result<Certificate> read_certificate(const std::filesystem::path& file);
/// Refuses a world-readable key.
Result<Key> read_key(const std::filesystem::path& file);

/// Error: the key is not that of the certificate.
Result<> check_pair(const std::filesystem::path& key_file, const Key& key,
                    const std::filesystem::path& certificate_file, const Certificate& certificate);

}  // namespace orbwatch::app
