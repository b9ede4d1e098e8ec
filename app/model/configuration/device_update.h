// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "proc/image/result.h"

namespace orbwatch::app {

/// Updates of a device that runs an image with two slots, for interfaces by which users ask for
/// them. One upload or installation at a time. Thread-safe.
class DeviceUpdate {
 public:
  /// Result of the newest update.
  enum class Trial {
    Kept,       ///< the running version is kept
    OnTrial,    ///< the running version is on trial
    Installed,  ///< another version is installed, and tried at the next start
    Returned    ///< another version was tried, and this one runs again
  };

  enum class Work { None, Uploading, Checking, Installing };

  struct State {
    std::string version;  ///< the running one
    std::string slot;     ///< the running one: a or b
    Trial trial = Trial::Kept;
    std::string other;   ///< version that is installed, or that the device returned from
    std::string reason;  ///< why it returned
    /// Seconds, during a trial; kept_in is nullopt while the version does not work.
    std::optional<std::int64_t> returns_in, kept_in;
    std::string refusal;  ///< why it accepts no update at present; empty: it does
    Work work = Work::None;
    int percent = 0;      ///< progress of the work
    std::string step;     ///< RAUC's name of what it does
    std::string failure;  ///< why the newest upload or installation failed; empty: it did not
  };

  virtual ~DeviceUpdate() = default;

  /// Reads the disk.
  virtual State state() const = 0;

  /// Adds bytes to a bundle of `whole` bytes; at offset 0 a new one begins. Returns its size so
  /// far. Errors: the device accepts no update at present; another offset than the size so far; no
  /// room; an installation is under way.
  virtual Result<std::uint64_t> upload(std::uint64_t offset, std::uint64_t whole,
                                       std::string_view bytes) = 0;

  /// Begins to check and install the uploaded bundle, which is deleted afterwards. Errors: it has
  /// not arrived completely; an installation is under way.
  virtual Result<> install() = 0;

  /// Restarts the computer, which then tries the installed version. Error: none is installed.
  virtual Result<> restart_device() = 0;

  /// Ends work under way, and all later work, with an error: the interfaces end. RAUC completes an
  /// installation by itself.
  virtual void cancel() = 0;
};

}  // namespace orbwatch::app
