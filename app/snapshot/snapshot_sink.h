#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "app/commands.h"
#include "app/pipeline/sink.h"

namespace orbwatch::app {

struct SnapshotSettings {
  std::filesystem::path folder;
  int keep = 100;
};

/// Writes a view's next picture as PNG when it is asked to, on a thread of its own:
/// VIEW_YYYYMMDDTHHMMSS.mmmZ_FRAMESET.png by the UTC of its exposure. A raw measured plane goes
/// beside it, as VIEW_..._measured.png. Keeps the newest; others' files in the folder are left
/// alone. At most one picture of each view waits to be written.
/// Thread rule: as Sink's; command on any thread.
class SnapshotSink final : public Sink {
 public:
  explicit SnapshotSink(SnapshotSettings settings) : settings_(std::move(settings)) {}
  ~SnapshotSink() override;

  /// CommandCode::Snapshot. Busy while one of that view is asked for or written.
  CommandResult command(const Command& command);

  /// Makes the folder. Error: it cannot be made or not be written to.
  Result<> start() override;
  /// Writes what was taken before it returns; what was asked for since then never comes.
  void stop() override;
  void accept(const ViewPtr& view) override;
  void accept(const Status&) override {}

  /// Snapshots since start that are on the disk.
  std::uint64_t written() const { return written_; }

 private:
  void run();
  ViewPtr take();
  Result<> write(const View& view, const std::string& name);
  Result<> remove_oldest(const std::string& newest);

  const SnapshotSettings settings_;
  std::array<std::atomic<bool>, kMaxViews> busy_{};    ///< by view: asked for or written
  std::array<std::atomic<bool>, kMaxViews> wanted_{};  ///< by view: its next picture
  std::mutex mutex_;
  std::condition_variable work_;
  std::array<ViewPtr, kMaxViews> taken_;  ///< by view: to be written
  bool stopping_ = false;
  std::atomic<std::uint64_t> written_{0};
  std::thread thread_;
};

}  // namespace orbwatch::app
