// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/look_around/ball_pictures.h"

#include <algorithm>
#include <utility>

#include "app/log.h"
#include "app/model/alignment/alignment.h"

namespace orbwatch::app::web {
namespace {

bool shows_alone(const PublishedView& view, const std::string& camera) {
  return view.is_own_picture && view.sources.front().camera == camera;
}

}  // namespace

BallPictures::BallPictures(const WebContext& context) : source_(context.alignment) {
  for (std::size_t i = 0; source_ && i < context.balls.size(); ++i) {
    const std::string& camera = context.names.cameras[i];
    const bool is_shown = std::ranges::any_of(
        context.views, [&](const PublishedView& view) { return shows_alone(view, camera); });
    if (is_shown || !context.balls[i] || !source_->report(i).is_watched) continue;
    balls_.push_back({"ball:" + camera, i, context.balls[i]});
  }
}

std::vector<LiveStream::Source> BallPictures::feeds() const {
  std::vector<LiveStream::Source> feeds;
  for (const Ball& ball : balls_) feeds.push_back({ball.name, ball.feed});
  return feeds;
}

/// A picture is wanted until it comes, so that a camera that was unplugged continues. A refused
/// request is repeated by the next call; the status states the camera's fault.
void BallPictures::follow() {
  for (const Ball& ball : balls_) {
    if (!ball.feed->is_wanted() || ball.is_requested->exchange(true)) continue;
    const auto on_pictures = [feed = ball.feed,
                              is_requested = ball.is_requested](Result<AlignmentJpegs> made) {
      if (made) {
        Item picture;
        picture.bytes = std::make_shared<const std::string>(std::move(made->files.front()));
        picture.stamp = made->stamp;
        feed->publish(std::move(picture));
      } else {
        log_line(LogLevel::Error, "web: " + made.error().message);
      }
      *is_requested = false;
    };
    AlignmentPicture picture;
    picture.camera = ball.camera;
    if (!source_->request(picture, on_pictures, [] { return true; })) *ball.is_requested = false;
  }
}

}  // namespace orbwatch::app::web
