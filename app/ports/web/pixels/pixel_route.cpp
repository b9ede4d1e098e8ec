// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/pixels/pixel_route.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "app/ports/web/api/typed_route.h"
#include "app/ports/web/pixels/pixel.h"

namespace orbwatch::app::web {
namespace {

std::string gone(std::uint64_t number, const std::string& view) {
  return "picture " + std::to_string(number) + " of view " + view +
         " is not kept: only the newest few since the first request are; request a later picture, "
         "or the next one without a number";
}

/// Projection of a view's picture. A ball's picture is not pointed; other kinds are projected with
/// the view's own parameters.
Result<optics::ViewProjection> projection_of(const View& view, const PublishedView& published) {
  if (published.ball) return *published.ball;
  return optics::ViewProjection::make(view.spec);
}

}  // namespace

PixelRoute::PixelRoute(const WebContext& context)
    : names_(context.names.views),
      views_(context.views),
      ball_(context.ball),
      scene_(context.scene) {}

void PixelRoute::pixel(const PixelQuery& query, const ExchangePtr& exchange) {
  const auto view = index_of("view", query.view, names_);
  if (!view) {
    exchange->answer(view.error());
    return;
  }
  recent_.point(*view, hal::Clock::now());
  const Question question{exchange, *view, query.pixel};
  if (!query.number) return wait(question);
  const ViewPtr kept = recent_.find(*view, *query.number);
  if (kept) return answer(question, *kept, *query.number);
  exchange->answer(error_response(410, gone(*query.number, query.view)));
}

/// Adds a waiting question, and removes those that the server has answered at their deadline.
void PixelRoute::wait(Question question) {
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [](const Question& other) { return other.exchange->is_answered(); });
  waiting_.push_back(std::move(question));
}

void PixelRoute::show(const ViewPtr& view, std::uint64_t number) {
  // A view rendered before the first request has no counts.
  const bool lacks_counts = view->kelvin_per_count > 0 && view->counts.empty();
  if (lacks_counts || !recent_.wants(view->index, hal::Clock::now())) return;
  recent_.keep(view, number);
  std::vector<Question> answered;
  {
    const std::lock_guard lock(mutex_);
    const auto rest = std::stable_partition(
        waiting_.begin(), waiting_.end(),
        [&](const Question& question) { return question.view != view->index; });
    answered.assign(std::move_iterator(rest), std::move_iterator(waiting_.end()));
    waiting_.erase(rest, waiting_.end());
  }
  for (const Question& question : answered) answer(question, *view, number);
}

void PixelRoute::stop() {
  recent_.release_all();
  const std::lock_guard lock(mutex_);
  waiting_.clear();
}

void PixelRoute::answer(const Question& question, const View& view, std::uint64_t number) const {
  question.exchange->answer(response_of(values_at(question.pixel, view, number)));
}

Answered<PixelAnswer> PixelRoute::values_at(const optics::Vec2& pixel, const View& view,
                                            std::uint64_t number) const {
  const int width = view.picture.width, height = view.picture.height;
  if (pixel.u > width - 1 || pixel.v > height - 1) {
    return refuse(
        400, "the picture has " + std::to_string(width) + "x" + std::to_string(height) + " pixels");
  }
  const auto projection = projection_of(view, views_[view.index]);
  if (!projection) return refuse(projection.error());
  PixelAnswer values = pixel_of(view, *projection, ball_, scene_, pixel);
  values.number = number;
  return values;
}

}  // namespace orbwatch::app::web
