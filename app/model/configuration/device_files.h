// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::app {

/// Support file, backup, restore and factory reset of the whole device, for interfaces by which
/// users ask for them. Thread-safe; all wait for the disk and for another program, one at a time.
class DeviceFiles {
 public:
  /// A file that was made; it stays until another of its kind is made, or the program ends.
  struct Made {
    std::filesystem::path file;
    std::string report;  ///< lines about its contents
  };

  /// Texts of the running program for a support file, by name.
  using Figures = std::vector<std::pair<std::string, std::string>>;

  /// Another device for a camera of a restored configuration.
  struct CameraAddress {
    std::string camera;
    std::string address;
  };

  struct Restore {
    std::optional<std::string> passphrase;  ///< for the secrets; nullopt: this device's are kept
    std::vector<CameraAddress> cameras;
    bool events = true;  ///< also the kept events of the backup
  };

  virtual ~DeviceFiles() = default;

  /// See `orbwatch support`. `pictures`: also pictures.
  virtual Result<Made> support(const Figures& figures, bool pictures) = 0;

  /// See `orbwatch backup`. Without a passphrase secrets are left out. `events`: also kept events.
  virtual Result<Made> backup(const std::optional<std::string>& passphrase, bool events) = 0;

  /// Adds bytes to the backup that is to be restored; at offset 0 a new one begins. Returns its
  /// size. Errors: another offset than its size; larger than a backup can be; the disk.
  virtual Result<std::uint64_t> upload(std::uint64_t offset, std::string_view bytes) = 0;

  /// Checks the uploaded backup; changes nothing. Returns what it has, compared with this device,
  /// as `orbwatch restore --json` prints it. Errors: no backup, damaged, not valid here.
  virtual Result<std::string> check(const Restore& restore) = 0;

  /// The same, and replaces the files before the program starts the next time. The caller then asks
  /// for a restart.
  virtual Result<std::string> restore(const Restore& restore) = 0;

  /// Puts the delivered configuration in place under the same rule.
  virtual Result<> reset() = 0;

  /// Restarts the program, also with a configuration that would be refused.
  virtual void restart() = 0;

  /// Ends calls under way, and all later ones, with an error: the interfaces end.
  virtual void cancel() = 0;
};

}  // namespace orbwatch::app
