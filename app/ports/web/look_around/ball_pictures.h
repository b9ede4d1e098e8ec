// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/ports/web/streams/picture_feeds.h"
#include "app/ports/web/streams/picture_sizes.h"
#include "app/ports/web/web_context.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app::web {

/// Whole pictures of the registered cameras that no view of kind ball shows alone, so that users
/// can look around without configuring one; named "ball:" and the camera's name. The watch of
/// alignments makes a picture when follow() finds readers, in the sizes that they ask for; without
/// readers there is no cost. Thread rule: follow on one thread at a time; everything else on any
/// thread.
class BallPictures {
 public:
  /// Requests of one camera's pictures; pending ones outlive this object.
  struct Requests {
    std::array<std::atomic<bool>, kQuarters.size()> are_pending{};  ///< by size
    std::atomic<std::uint64_t> pictures{0};                         ///< number of the newest one
  };
  struct Ball {
    std::string name;
    std::size_t camera = 0;
    std::shared_ptr<const optics::ViewProjection> view;
    PictureFeeds feeds{};
    std::shared_ptr<Requests> requests = std::make_shared<Requests>();
  };

  explicit BallPictures(const WebContext& context);

  const std::vector<Ball>& all() const { return balls_; }
  std::vector<PictureSource> sources() const;

  /// Requests one picture of each ball and size that has readers and no pending request.
  void follow();

 private:
  void request(const Ball& ball, std::size_t size);

  AlignmentSource* const source_;
  std::vector<Ball> balls_;
};

}  // namespace orbwatch::app::web
