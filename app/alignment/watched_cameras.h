// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/pictures/picture_copy.h"
#include "hal/fault.h"
#include "hal/thread/shared_threads.h"
#include "proc/align/drift/drift_monitor.h"
#include "proc/align/work_progress.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// A running site's cameras beside the frame path: their next pictures, and their drift. Cameras by
/// their index in the site. Thread rule: record() for one caller at a time; the rest on any thread.
class WatchedCameras {
 public:
  virtual ~WatchedCameras() = default;

  virtual bool is_watched(std::size_t camera) const = 0;

  /// Fault of a camera, by the newest status.
  virtual hal::Fault fault(std::size_t camera) const = 0;

  /// The newest drift of a camera that is watched, was seen and has no fault.
  virtual std::optional<align::DriftState> drift(std::size_t camera) const = 0;

  /// Has the next picture of a watched camera copied for `reader`, which is called once, on a
  /// shared thread, and must return soon. Never called after the watching has stopped.
  virtual void ask(std::size_t camera, std::function<void(RecordedPicture)> reader) = 0;

  /// The same with the next frame set that has a new picture of each of these cameras, which are in
  /// their order and have the set's time. Error: no set of some seconds has them all.
  virtual void ask_together(std::vector<std::size_t> cameras,
                            std::function<void(Result<std::vector<RecordedPicture>>)> reader) = 0;

  /// Waits for the next pictures of watched cameras, at most `count` of each; fewer when `patience`
  /// ends. All are of frame sets that have a new picture of each of these cameras, and those of one
  /// set have the same time. Error: one of them delivers none; cancelled by `progress`.
  virtual Result<std::vector<std::vector<RecordedPicture>>> record(
      const std::vector<std::size_t>& cameras, std::size_t count, std::chrono::seconds patience,
      const align::WorkProgress& progress) = 0;

  /// Threads that readers are called on.
  virtual const std::shared_ptr<hal::SharedThreads>& threads() const = 0;
};

}  // namespace orbwatch::app
