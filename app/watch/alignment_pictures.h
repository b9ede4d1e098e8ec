#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>

#include "app/model/alignment.h"
#include "app/watch/camera_watch.h"
#include "hal/thread/shared_threads.h"

namespace orbwatch::app {

/// Makes pictures that alignments are judged by, on shared threads. Thread-safe.
class AlignmentPictures {
 public:
  /// One more is refused.
  static constexpr std::size_t kMostWaiting = 16;

  /// `watch` outlives it.
  explicit AlignmentPictures(CameraWatch& watch);

  /// As AlignmentSource::request(), through `ball`.
  Result<> request(const AlignmentPicture& picture, const optics::BallProjection& ball,
                   AlignmentSource::OnPicture on_picture);
  /// Waits for the picture under way and makes no other.
  void stop() { work_.cancel(); }

 private:
  struct Wanted {
    optics::BallProjection ball;
    std::optional<optics::ViewSpec> view;
    AlignmentSource::OnPicture on_picture;
  };
  struct Taken {
    std::shared_ptr<const Wanted> wanted;
    RecordedPicture picture;
  };

  void make();

  CameraWatch& watch_;
  std::mutex mutex_;
  std::size_t waiting_ = 0;  ///< of all that is not answered; under mutex_
  std::deque<Taken> taken_;  ///< under mutex_
  hal::SharedThreads::Work work_;
};

}  // namespace orbwatch::app
