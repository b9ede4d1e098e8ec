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

std::vector<PictureSource> BallPictures::sources() const {
  std::vector<PictureSource> sources;
  for (const Ball& ball : balls_) sources.push_back({ball.name, ball.view->width(), ball.feeds});
  return sources;
}

void BallPictures::follow() {
  for (const Ball& ball : balls_) {
    for (std::size_t size = 0; size < kQuarters.size(); ++size) {
      if (ball.feeds.of(size)->is_wanted()) request(ball, size);
    }
  }
}

/// A picture is wanted until it comes, so that a camera that was unplugged continues. A refused
/// request is repeated by the next follow(); the status states the camera's fault.
void BallPictures::request(const Ball& ball, std::size_t size) {
  std::atomic<bool>& is_pending = ball.requests->are_pending[size];
  if (is_pending.exchange(true)) return;
  const int width = ball.view->width(), height = ball.view->height();
  AlignmentPicture wanted;
  wanted.camera = ball.camera;
  wanted.width = side_in(size, width);
  wanted.height = side_in(size, height);
  const auto on_pictures = [feed = ball.feeds.of(size), requests = ball.requests, size, width,
                            height](Result<AlignmentJpegs> made) {
    if (made) {
      Item picture;
      picture.bytes = std::make_shared<const std::string>(std::move(made->files.front()));
      picture.number = ++requests->pictures;
      picture.stamp = made->stamp;
      picture.width = width;
      picture.height = height;
      feed->publish(std::move(picture));
    } else {
      log_line(LogLevel::Error, "web: " + made.error().message);
    }
    requests->are_pending[size] = false;
  };
  if (!source_->request(wanted, on_pictures, [] { return true; })) is_pending = false;
}

}  // namespace orbwatch::app::web
