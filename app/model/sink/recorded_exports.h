// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "proc/image/result.h"
#include "proc/settings/settings.h"

namespace orbwatch::app {

/// Kinds of files that an event is exported as.
enum class ExportFormat : std::uint8_t { Mcap, Csv, Tiff, Avi, Zip };

inline constexpr std::array kExportFormats{
    Word{"mcap", ExportFormat::Mcap}, Word{"csv", ExportFormat::Csv},
    Word{"tif", ExportFormat::Tiff}, Word{"avi", ExportFormat::Avi},
    Word{"zip", ExportFormat::Zip}};

struct ExportRequest {
  std::string event;
  ExportFormat format = ExportFormat::Mcap;
  std::string camera;  ///< of tif and avi; may be empty if the event has pictures of one alone
  /// Numbers of frame sets, or UTC; both ends belong to it. Empty: that of the event.
  std::string from, to;
  bool draws = false;  ///< values of each frame set, into the pictures of avi
  std::string user;    ///< name of whoever asks; empty: there are no users
};

enum class ExportState : std::uint8_t { None, Making, Ready, Failed };

inline constexpr std::array kExportStates{
    Word{"none", ExportState::None}, Word{"making", ExportState::Making},
    Word{"ready", ExportState::Ready}, Word{"failed", ExportState::Failed}};

/// The newest export.
struct ExportStatus {
  std::uint64_t number = 0;  ///< counts exports since the start
  ExportState state = ExportState::None;
  std::string event, user;
  std::string file;                ///< name for people
  std::uint64_t done = 0, of = 0;  ///< parts of its present step
  std::string unit;                ///< of these parts, such as "pictures"
  std::uint64_t bytes = 0;         ///< written so far
  std::string error;               ///< reason of a failure
};

/// Exports of the recorder's events, one at a time: a file is made on a thread of the object, and
/// kept for a while until it is taken. All but start() and stop() are thread-safe.
class RecordedExports {
 public:
  virtual ~RecordedExports() = default;

  virtual void start() = 0;
  /// Cancels what is being made, and removes files.
  virtual void stop() = 0;
  virtual std::chrono::nanoseconds cpu_time() const = 0;

  /// Begins an export, and returns its number; a file that nobody has taken is removed. Errors: one
  /// is being made, or another user's waits to be taken; no such event; a range that is not one.
  /// Waits for the disk.
  virtual Result<std::uint64_t> begin(const ExportRequest& request) = 0;
  virtual ExportStatus status() const = 0;
  /// The finished file of an export. Error: there is none.
  virtual Result<std::filesystem::path> file(std::uint64_t number) const = 0;
  /// Cancels an export, or removes its file. Error: it is not the newest, or has ended.
  virtual Result<> remove(std::uint64_t number) = 0;
};

}  // namespace orbwatch::app
