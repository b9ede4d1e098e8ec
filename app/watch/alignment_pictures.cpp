#include "app/watch/alignment_pictures.h"

#include <utility>

#include "app/watch/alignment_jpeg.h"

namespace orbwatch::app {

AlignmentPictures::AlignmentPictures(CameraWatch& watch)
    : watch_(watch), work_(watch.threads(), [this] { make(); }) {}

Result<> AlignmentPictures::request(const AlignmentPicture& picture,
                                    const optics::BallProjection& ball,
                                    AlignmentSource::OnPicture on_picture) {
  if (!watch_.is_watched(picture.camera)) {
    return fail("the camera is not watched: enabled in its [camera.watch], or the log says why");
  }
  {
    const std::lock_guard lock(mutex_);
    if (waiting_ == kMostWaiting) {
      return fail(std::to_string(kMostWaiting) + " pictures are asked for already; try again");
    }
    ++waiting_;
  }
  const auto wanted =
      std::make_shared<const Wanted>(Wanted{ball, picture.view, std::move(on_picture)});
  watch_.ask(picture.camera, [this, wanted](RecordedPicture taken) {
    {
      const std::lock_guard lock(mutex_);
      taken_.push_back({wanted, std::move(taken)});
    }
    work_.request();
  });
  return {};
}

void AlignmentPictures::make() {
  while (true) {
    Taken next;
    {
      const std::lock_guard lock(mutex_);
      if (taken_.empty()) return;
      next = std::move(taken_.front());
      taken_.pop_front();
      --waiting_;
    }
    const Wanted& wanted = *next.wanted;
    wanted.on_picture(alignment_jpeg(next.picture.picture, wanted.ball, wanted.view));
  }
}

}  // namespace orbwatch::app
