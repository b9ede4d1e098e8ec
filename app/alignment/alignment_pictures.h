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

/// Makes pictures that alignments are judged by, alone or in pairs, on shared threads. Thread-safe.
class AlignmentPictures {
 public:
  /// Limit for one camera, alone and in pairs; one more is refused. A camera that delivers nothing
  /// leaves the others theirs.
  static constexpr std::size_t kMostWaiting = 16;

  /// `watch` outlives it.
  explicit AlignmentPictures(WatchedCameras& watch);

  /// Requests a picture or a pair as AlignmentSource::request() does, through `balls`, of each
  /// camera in the order of the files.
  Result<> request(const AlignmentPicture& picture, std::vector<optics::BallProjection> balls,
                   AlignmentSource::OnPictures on_pictures, AlignmentSource::IsWanted is_wanted);
  /// Waits for the picture under way and makes no other.
  void stop() { work_.cancel(); }

 private:
  using Recorded = Result<std::vector<RecordedPicture>>;  ///< of the cameras of a queue
  struct Wanted {
    AlignmentPicture picture;
    std::vector<optics::BallProjection> balls;
    AlignmentSource::OnPictures on_pictures;
    AlignmentSource::IsWanted is_wanted;
  };
  /// Requests that wait for a camera's next picture, or for the next one beside the first camera's.
  struct Queue {
    std::vector<Wanted> waiting;
    bool is_served = false;  ///< from the request for that picture until its answers are made
  };
  struct Taken {
    std::size_t queue = 0;
    std::vector<Wanted> wanted;
    Recorded pictures;
  };
  static constexpr std::size_t kQueues = 2 * kMaxCameras;

  Result<> check(std::size_t camera) const;
  void ask(std::size_t queue);
  void take(std::size_t queue, Recorded pictures);
  void make();
  static Result<AlignmentJpegs> made_for(const Wanted& wanted, const Recorded& pictures);

  WatchedCameras& watch_;
  std::mutex mutex_;
  std::array<Queue, kQueues> queues_;  ///< per camera alone, then beside the first; under mutex_
  hal::BoundedQueue<Taken, kQueues> taken_;  ///< at most one of each queue
  hal::SharedThreads::Work work_;
};

}  // namespace orbwatch::app
