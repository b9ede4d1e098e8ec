// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "app/model/command/command.h"
#include "app/model/sink/sink.h"
#include "app/ports/snapshot/snapshot_settings.h"
#include "hal/thread/bounded_queue.h"
#include "hal/thread/thread.h"

namespace orbwatch::app {

/// Writes a view's next picture as PNG on request, on a separate thread:
/// VIEW_YYYYMMDDTHHMMSS.mmmZ_FRAMESET.png by the UTC of its exposure. A raw measured plane is
/// written as VIEW_..._measured.png. Keeps the snapshots written last, by the files' modification
/// times: if the clock was set back, a new file is dated just after the newest one. Other files in
/// the folder are not touched. At most one picture of each view waits to be written.
/// Thread rule: as Sink; request on any thread.
class SnapshotSink final : public Sink {
 public:
  explicit SnapshotSink(SnapshotSettings settings) : settings_(std::move(settings)) {}
  ~SnapshotSink() override;

  /// Requests the next picture of a view. Busy while a picture of that view is requested or
  /// written; NotPossible: the view is not live; ArgumentOutOfRange: no such view.
  CommandResult request(std::size_t view);

  /// Creates the folder, and removes incomplete files of an earlier run. Error: the folder cannot
  /// be created or is not writable.
  Result<> start() override;
  /// Writes the accepted views first; requests without a view are dropped.
  void stop() override { thread_.stop(); }
  std::chrono::nanoseconds cpu_time() const override { return thread_.cpu_time(); }
  PictureNeeds needs(std::size_t view, hal::TimePoint stamp) override;
  /// One picture of each view is being written or waits to be written.
  KeptViews keeps() const override { return {1, 0}; }
  void accept(const ViewPtr& view) override;
  /// Drops requests of views that are no longer live.
  void accept(const Status& status) override;

  /// Snapshots since start that are on disk.
  std::uint64_t written() const { return written_; }

 private:
  void write_all();
  Result<> write(const View& view, const std::string& name);
  Result<> remove_oldest(const std::string& newest);

  const SnapshotSettings settings_;
  std::array<std::atomic<bool>, kMaxViews> live_{};  ///< indexed by view
  /// Indexed by view: requested or being written.
  std::array<std::atomic<bool>, kMaxViews> busy_{};
  /// Indexed by view: request for its next picture.
  std::array<std::atomic<bool>, kMaxViews> wanted_{};
  /// Indexed by view: the next picture serves a request; used by accept()'s thread only.
  std::bitset<kMaxViews> asked_;
  hal::BoundedQueue<ViewPtr, kMaxViews> accepted_;  ///< to be written, at most one of each view
  std::atomic<std::uint64_t> written_{0};
  hal::Thread thread_;
};

}  // namespace orbwatch::app
