// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "app/pictures/picture_copy.h"
#include "hal/clock.h"
#include "hal/sync/frame_set.h"
#include "hal/thread/shared_threads.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Copies the frames of one set for readers that compare cameras. Requests are served in order.
/// Thread rule: accept() on the pipeline's thread, stop() by the owner, the rest on any thread.
class FrameSetCopies {
 public:
  /// Called once, on a shared thread; must return soon.
  using Reader = std::function<void(Result<std::vector<RecordedPicture>>)>;

  /// Time between the first and the last set that may be incomplete, by their stamps.
  static constexpr std::chrono::seconds kPatience{3};

  explicit FrameSetCopies(std::shared_ptr<hal::SharedThreads> threads);

  /// Has the next set copied that has a new frame of each of `cameras`, in their order; all have
  /// the set's time. Error: none within kPatience has.
  void ask(std::vector<std::size_t> cameras, Reader reader);
  void accept(const hal::FrameSet& set);
  /// Waits for a reader that is being called, and calls no other.
  void stop() { work_.cancel(); }

  std::chrono::nanoseconds cpu_time() const { return work_.cpu_time(); }

 private:
  struct Request {
    std::vector<std::size_t> cameras;
    Reader reader;
  };

  void begin();
  void serve();
  Result<std::vector<RecordedPicture>> copies() const;

  std::mutex mutex_;
  std::deque<Request> requests_;  ///< under mutex_; the first one is being served

  /// The members below belong to the pipeline's thread while it is true, else to the others.
  std::atomic<bool> is_waiting_{false};
  std::vector<std::size_t> cameras_;
  std::optional<hal::TimePoint> since_;  ///< stamp of the first set since the request
  hal::TimePoint stamp_;
  std::array<hal::Frame, hal::kMaxCameras> frames_;  ///< null: no set was complete
  hal::SharedThreads::Work work_;
};

}  // namespace orbwatch::app
