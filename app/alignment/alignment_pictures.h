// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "app/alignment/watched_cameras.h"
#include "app/model/alignment/alignment.h"
#include "hal/thread/bounded_queue.h"
#include "hal/thread/shared_threads.h"

namespace orbwatch::app {

/// Makes pictures that alignments are judged by, on shared threads. Thread-safe.
class AlignmentPictures {
 public:
  /// Limit for one camera; one more is refused. A camera that delivers nothing leaves the others
  /// theirs.
  static constexpr std::size_t kMostWaiting = 16;

  /// `watch` outlives it.
  explicit AlignmentPictures(WatchedCameras& watch);

  /// Requests a picture as AlignmentSource::request() does, through `ball`.
  Result<> request(const AlignmentPicture& picture, const optics::BallProjection& ball,
                   AlignmentSource::OnPicture on_picture, AlignmentSource::IsWanted is_wanted);
  /// Waits for the picture under way and makes no other.
  void stop() { work_.cancel(); }

 private:
  struct Wanted {
    optics::BallProjection ball;
    std::optional<optics::ViewSpec> view;
    AlignmentSource::OnPicture on_picture;
    AlignmentSource::IsWanted is_wanted;
  };
  /// Requests that wait for one camera's next picture.
  struct Queue {
    std::vector<Wanted> waiting;
    bool is_served = false;  ///< from the request for that picture until its answers are made
  };
  struct Taken {
    std::size_t camera = 0;
    std::vector<Wanted> wanted;
    RecordedPicture picture;
  };

  void ask(std::size_t camera);
  void take(std::size_t camera, RecordedPicture picture);
  void make();

  WatchedCameras& watch_;
  std::mutex mutex_;
  std::array<Queue, kMaxCameras> queues_;        ///< one per camera; under mutex_
  hal::BoundedQueue<Taken, kMaxCameras> taken_;  ///< at most one of each camera
  hal::SharedThreads::Work work_;
};

}  // namespace orbwatch::app
