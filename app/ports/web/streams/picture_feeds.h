// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <string>

#include "app/ports/web/streams/feed.h"
#include "app/ports/web/streams/picture_sizes.h"

namespace orbwatch::app::web {

/// Feeds of a view's pictures, one for each of its sizes. Copies share them. Thread-safe.
class PictureFeeds {
 public:
  PictureFeeds() {
    for (auto& feed : feeds_) feed = std::make_shared<Feed>();
  }

  /// Feed of a size, a place in kQuarters.
  const std::shared_ptr<Feed>& of(std::size_t size) const { return feeds_[size]; }

  /// Returns whether a picture is wanted in any size. Takes no lock.
  bool are_wanted() const {
    return std::ranges::any_of(feeds_, [](const auto& feed) { return feed->is_wanted(); });
  }

 private:
  std::array<std::shared_ptr<Feed>, kQuarters.size()> feeds_;
};

/// Pictures that clients ask for by name.
struct PictureSource {
  std::string name;
  int width = 0;  ///< of the full picture, px
  PictureFeeds feeds;
};

}  // namespace orbwatch::app::web
