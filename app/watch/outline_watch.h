// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "app/model/status/status.h"
#include "app/watch/outline_check.h"
#include "hal/thread/shared_threads.h"
#include "proc/image/picture.h"

namespace orbwatch::app {

/// Compares the outline that the rig states for one camera with its ball, in a picture that is
/// kept. Detection takes up to seconds: it has threads of its own and works on a copy, since a
/// frame that waited for it would keep a buffer of the driver, which may have two only. Thread
/// rule: check() and stop() on one thread, the rest on any.
class OutlineWatch {
 public:
  /// `name`: the camera's.
  OutlineWatch(std::string name, std::shared_ptr<hal::SharedThreads> threads);

  /// Requests the comparison and returns at once. The result is logged.
  void check(OutlineSubject subject);
  /// Sets the figures of the newest comparison.
  void report(CameraWatchStatus& figures) const;
  /// Waits for a comparison that runs, and begins no other.
  void stop() { work_.cancel(); }

  std::chrono::nanoseconds cpu_time() const { return work_.cpu_time(); }

 private:
  void compare();
  void log(const OutlineCheck& check) const;

  const std::string name_;
  mutable std::mutex mutex_;               ///< guards these two, held only while they are moved
  std::optional<OutlineSubject> subject_;  ///< requested
  OutlineCheck checked_;
  hal::SharedThreads::Work work_;
};

}  // namespace orbwatch::app
