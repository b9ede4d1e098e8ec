// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "app/ports/web/streams/feed.h"
#include "app/ports/web/streams/live_stream.h"
#include "app/ports/web/web_context.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app::web {

/// Whole pictures of the registered cameras that no view of kind ball shows alone, so that users
/// can look around without configuring one: a feed for each, named "ball:" and the camera's name.
/// The watch of alignments makes a picture when follow() finds readers; without readers there is no
/// cost. Thread rule: follow on one thread at a time; everything else on any thread.
class BallPictures {
 public:
  struct Ball {
    std::string name;
    std::size_t camera = 0;
    std::shared_ptr<const optics::ViewProjection> view;
    std::shared_ptr<Feed> feed = std::make_shared<Feed>();
    /// True from a request until its picture; outlives this object in a pending request.
    std::shared_ptr<std::atomic<bool>> is_requested = std::make_shared<std::atomic<bool>>(false);
  };

  explicit BallPictures(const WebContext& context);

  const std::vector<Ball>& all() const { return balls_; }
  std::vector<LiveStream::Source> feeds() const;

  /// Requests one picture of each ball that has readers and no pending request.
  void follow();

 private:
  AlignmentSource* const source_;
  std::vector<Ball> balls_;
};

}  // namespace orbwatch::app::web
