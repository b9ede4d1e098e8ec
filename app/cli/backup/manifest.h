// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "proc/image/result.h"
#include "proc/settings/settings.h"

namespace orbwatch::app::cli::backup {

/// Newest format of a backup: its manifest, encryption and names. A newer one is refused. A backup
/// without events has format 1, which the first versions read.
inline constexpr int kFormat = 2;

/// Secret files of a backup.
enum class Secrets { None, Encrypted, LeftOut };

inline constexpr std::array kSecretsWords{Word{"none", Secrets::None},
                                          Word{"encrypted", Secrets::Encrypted},
                                          Word{"left_out", Secrets::LeftOut}};

/// A file of a backup that is not encrypted.
struct ManifestFile {
  std::string name;
  std::string sha256;
  std::size_t size = 0;
  mode_t mode = 0;
};

/// A kept event of the recorder in a backup.
struct ManifestEvent {
  std::string name;
  std::uint64_t bytes = 0;  ///< of all its files

  bool operator==(const ManifestEvent&) const = default;
};

/// Description of a backup; also authenticated with its secrets.
struct Manifest {
  std::string version;  ///< product version
  std::string made;     ///< UTC
  std::string host;     ///< name of the device
  std::string site;     ///< name of the configuration file
  Secrets secrets = Secrets::None;
  std::vector<ManifestFile> files{};
  std::vector<std::string> secret_files{};  ///< their names, also if they are left out
  std::vector<std::string> left_out{};      ///< other files that are not in it, with the reason
  std::vector<ManifestEvent> events{};      ///< in the order in which they follow
};

std::string manifest_text(const Manifest& manifest);

/// Errors: damaged; a newer format. Unknown members are ignored. Reentrant.
Result<Manifest> parse_manifest(std::string_view text);

}  // namespace orbwatch::app::cli::backup
