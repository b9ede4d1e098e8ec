// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/alignment_pictures.h"

#include <string>
#include <utility>

#include "app/alignment/alignment_jpeg.h"
#include "hal/fault.h"

namespace orbwatch::app {

AlignmentPictures::AlignmentPictures(WatchedCameras& watch)
    : watch_(watch), work_(watch.threads(), [this] { make(); }) {}

Result<> AlignmentPictures::check(std::size_t camera) const {
  if (!watch_.is_watched(camera)) {
    return fail("the camera is not watched: enabled in its [camera.watch], or the log says why");
  }
  if (const hal::Fault fault = watch_.fault(camera); fault != hal::Fault::None) {
    return fail("there is no picture: " + std::string(operator_text(fault)));
  }
  return {};
}

Result<> AlignmentPictures::request(const AlignmentPicture& picture,
                                    std::vector<optics::BallProjection> balls,
                                    AlignmentSource::OnPictures on_pictures,
                                    AlignmentSource::IsWanted is_wanted) {
  if (const auto checked = check(picture.camera); !checked) return checked;
  if (picture.is_beside_first) {
    if (const auto first = check(0); !first) return fail("first camera: " + first.error().message);
  }
  const std::size_t place = picture.camera + (picture.is_beside_first ? kMaxCameras : 0);
  {
    const std::lock_guard lock(mutex_);
    Queue& queue = queues_[place];
    std::erase_if(queue.waiting, [](const Wanted& other) { return !other.is_wanted(); });
    if (queue.waiting.size() == kMostWaiting) {
      return fail(std::to_string(kMostWaiting) +
                  " pictures of the camera are asked for already; try again");
    }
    queue.waiting.push_back(
        {picture, std::move(balls), std::move(on_pictures), std::move(is_wanted)});
    if (std::exchange(queue.is_served, true)) return {};
  }
  ask(place);
  return {};
}

void AlignmentPictures::ask(std::size_t queue) {
  if (queue >= kMaxCameras) {
    watch_.ask_together({0, queue - kMaxCameras},
                        [this, queue](Recorded taken) { take(queue, std::move(taken)); });
    return;
  }
  watch_.ask(queue, [this, queue](RecordedPicture taken) {
    std::vector<RecordedPicture> pictures;
    pictures.push_back(std::move(taken));
    take(queue, std::move(pictures));
  });
}

void AlignmentPictures::take(std::size_t queue, Recorded pictures) {
  std::vector<Wanted> wanted;
  {
    const std::lock_guard lock(mutex_);
    wanted = std::exchange(queues_[queue].waiting, {});
  }
  taken_.put({queue, std::move(wanted), std::move(pictures)});
  work_.request();
}

Result<AlignmentJpegs> AlignmentPictures::made_for(const Wanted& wanted, const Recorded& pictures) {
  if (!pictures) return tl::unexpected(pictures.error());
  AlignmentJpegs jpegs{hal::TimePoint(pictures->front().time), {}};
  for (std::size_t n = 0; n < pictures->size(); ++n) {
    auto file = alignment_jpeg((*pictures)[n].picture, wanted.balls[n], wanted.picture);
    if (!file) return tl::unexpected(file.error());
    jpegs.files.push_back(std::move(*file));
  }
  return jpegs;
}

void AlignmentPictures::make() {
  while (const auto next = taken_.try_take()) {
    for (const Wanted& wanted : next->wanted) {
      if (!wanted.is_wanted()) continue;
      wanted.on_pictures(made_for(wanted, next->pictures));
    }
    bool is_next_wanted = false;
    {
      const std::lock_guard lock(mutex_);
      Queue& queue = queues_[next->queue];
      is_next_wanted = queue.is_served = !queue.waiting.empty();
    }
    if (is_next_wanted) ask(next->queue);
  }
}

}  // namespace orbwatch::app
