// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "app/model/sink/recorded_exports.h"
#include "app/ports/recorder/events/event_folder.h"
#include "app/ports/recorder/export/export_kinds.h"
#include "app/ports/recorder/recorder_settings.h"
#include "hal/thread/thread.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// Times of a file from when it was made.
struct ExportTimes {
  std::chrono::nanoseconds kept = std::chrono::minutes(10);  ///< until it is removed
  std::chrono::nanoseconds owned = std::chrono::minutes(1);  ///< until others' exports replace it
};

/// Exports in the folder `exports` of recordings, which it owns: emptied at its start and its end.
/// There is one file at a time. An export takes at most half of
/// the space above the recorder's reserve, so that however many readers hold removed files open,
/// none takes the reserve, for which recordings would be deleted.
class ExportSpool final : public RecordedExports {
 public:
  /// `kinds` has one of each format; outlives it.
  explicit ExportSpool(const RecorderSettings& settings, ExportTimes times = {},
                       std::span<const ExportKind> kinds = export_kinds());
  ~ExportSpool() override { ExportSpool::stop(); }

  void start() override;
  void stop() override;
  std::chrono::nanoseconds cpu_time() const override { return thread_.cpu_time(); }

  Result<std::uint64_t> begin(const ExportRequest& request) override;
  ExportStatus status() const override;
  Result<std::filesystem::path> file(std::uint64_t number) const override;
  Result<> remove(std::uint64_t number) override;

 private:
  /// An export to be made.
  struct Job {
    std::uint64_t number = 0;
    ExportKind kind;
    ExportSource source;  ///< without its range
    ExportRange range;
  };
  class Room;

  Result<Job> job_of(const ExportRequest& request) const;
  Result<> check_free(const ExportRequest& request) const;
  void run();
  hal::TimePoint next_wake() const;
  std::optional<Job> take_job();
  void make(Job job);
  bool end(const Result<>& written, std::uint64_t bytes);
  Result<> write(Job& job);
  bool is_wanted() const;
  void remove_old();
  std::filesystem::path path_of(std::uint64_t number) const;

  const std::filesystem::path folder_;
  const std::uint64_t reserve_;  ///< bytes
  const EventFolder events_;
  const ExportTimes times_;
  const std::span<const ExportKind> kinds_;
  mutable std::mutex mutex_;  ///< guards the members below, but not the thread
  bool is_started_ = false;
  ExportStatus status_;
  std::optional<Job> job_;     ///< waits for the thread
  bool is_cancelled_ = false;  ///< the newest export is not wanted any more
  hal::TimePoint made_{};      ///< when it ended
  hal::Thread thread_;
};

}  // namespace orbwatch::app::recorder
