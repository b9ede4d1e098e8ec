// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "app/model/sink/view.h"
#include "app/ports/web/api/route.h"
#include "app/ports/web/http/exchange.h"
#include "app/ports/web/pixels/pixel_records.h"
#include "app/ports/web/streams/recent_views.h"
#include "app/ports/web/web_context.h"

namespace orbwatch::app::web {

/// Serves the values at a pixel of a sent picture. A request makes the view's pictures kept from
/// then on; a request without a number is answered with the next one. Thread-safe.
class PixelRoute {
 public:
  explicit PixelRoute(const WebContext& context);

  void pixel(const PixelQuery& query, const ExchangePtr& exchange);

  /// Returns whether a client points into a view. Takes no lock.
  bool wants(std::size_t view, hal::TimePoint now) const { return recent_.wants(view, now); }
  /// Reports a picture that is about to be sent under this number.
  void show(const ViewPtr& view, std::uint64_t number);

  /// Releases views into which clients no longer point.
  void release_unwanted(hal::TimePoint now) { recent_.release_unwanted(now); }
  /// Stops; waiting requests are left to their deadline.
  void stop();

 private:
  struct Question {
    ExchangePtr exchange;
    std::size_t view;
    optics::Vec2 pixel;
  };

  void wait(Question question);
  void answer(const Question& question, const View& view, std::uint64_t number) const;
  Answered<PixelAnswer> values_at(const optics::Vec2& pixel, const View& view,
                                  std::uint64_t number) const;

  const std::vector<std::string> names_;
  const std::vector<PublishedView> views_;
  const optics::Ball ball_;
  const optics::SceneProxy scene_;
  RecentViews recent_;
  std::mutex mutex_;
  std::vector<Question> waiting_;  ///< questions for the next picture; guarded by mutex_
};

}  // namespace orbwatch::app::web
