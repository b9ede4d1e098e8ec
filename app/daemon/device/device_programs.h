// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/daemon/device/cli_program.h"
#include "app/daemon/device/uploaded_file.h"
#include "app/model/configuration/device_files.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::daemon {

/// DeviceFiles by the program `orbwatch`. Its files are in the folder device-files of the state
/// folder, mode 0700, which is emptied at the beginning.
class DevicePrograms final : public DeviceFiles {
 public:
  /// `config` is the configuration file, `state` its state folder. `restart` is called on any
  /// thread. `reserve` is the free space that a large upload leaves on the disk, bytes.
  DevicePrograms(std::filesystem::path config, const std::filesystem::path& state,
                 std::function<void()> restart, std::uint64_t reserve);

  Result<Made> support(const Figures& figures, bool pictures) override;
  Result<Made> backup(const std::optional<std::string>& passphrase, bool events) override;
  Result<std::uint64_t> upload(std::uint64_t offset, std::string_view bytes) override;
  Result<std::string> check(const Restore& restore) override;
  Result<std::string> restore(const Restore& restore) override;
  Result<> reset() override;
  void restart() override { restart_(); }
  void cancel() override { cancelled_.signal(); }

 private:
  Result<std::string> run(CliCall call) const;
  Result<Made> make(const char* name, CliCall call);
  Result<std::string> restored(const Restore& restore, const char* way);

  const std::filesystem::path config_;
  const std::filesystem::path folder_;
  const std::function<void()> restart_;
  const hal::EventFd cancelled_;
  std::mutex mutex_;  ///< held by each call: they have files in common, and need much memory
  BackupUpload upload_;
};

}  // namespace orbwatch::app::daemon
