// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/alignment_pictures.h"

#include <string>
#include <utility>

#include "app/alignment/alignment_jpeg.h"
#include "hal/fault.h"

namespace orbwatch::app {

AlignmentPictures::AlignmentPictures(WatchedCameras& watch)
    : watch_(watch), work_(watch.threads(), [this] { make(); }) {}

Result<> AlignmentPictures::request(const AlignmentPicture& picture,
                                    const optics::BallProjection& ball,
                                    AlignmentSource::OnPicture on_picture,
                                    AlignmentSource::IsWanted is_wanted) {
  if (!watch_.is_watched(picture.camera)) {
    return fail("the camera is not watched: enabled in its [camera.watch], or the log says why");
  }
  if (const hal::Fault fault = watch_.fault(picture.camera); fault != hal::Fault::None) {
    return fail("there is no picture: " + std::string(operator_text(fault)));
  }
  {
    const std::lock_guard lock(mutex_);
    Queue& queue = queues_[picture.camera];
    std::erase_if(queue.waiting, [](const Wanted& other) { return !other.is_wanted(); });
    if (queue.waiting.size() == kMostWaiting) {
      return fail(std::to_string(kMostWaiting) +
                  " pictures of the camera are asked for already; try again");
    }
    queue.waiting.push_back({ball, picture.view, std::move(on_picture), std::move(is_wanted)});
    if (std::exchange(queue.is_served, true)) return {};
  }
  ask(picture.camera);
  return {};
}

void AlignmentPictures::ask(std::size_t camera) {
  watch_.ask(camera, [this, camera](RecordedPicture taken) { take(camera, std::move(taken)); });
}

void AlignmentPictures::take(std::size_t camera, RecordedPicture picture) {
  std::vector<Wanted> wanted;
  {
    const std::lock_guard lock(mutex_);
    wanted = std::exchange(queues_[camera].waiting, {});
  }
  taken_.put({camera, std::move(wanted), std::move(picture)});
  work_.request();
}

void AlignmentPictures::make() {
  while (const auto next = taken_.try_take()) {
    for (const Wanted& wanted : next->wanted) {
      if (!wanted.is_wanted()) continue;
      wanted.on_picture(alignment_jpeg(next->picture.picture, wanted.ball, wanted.view),
                        hal::TimePoint(next->picture.time));
    }
    bool is_next_wanted = false;
    {
      const std::lock_guard lock(mutex_);
      Queue& queue = queues_[next->camera];
      is_next_wanted = queue.is_served = !queue.waiting.empty();
    }
    if (is_next_wanted) ask(next->camera);
  }
}

}  // namespace orbwatch::app
