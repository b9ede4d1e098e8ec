// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/pixels/pixel_route.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "app/ports/web/pixels/pixel.h"
#include "app/ports/web/query.h"

namespace orbwatch::app::web {
namespace {

/// Largest whole number that a double represents exactly.
constexpr double kMostNumber = 1LL << std::numeric_limits<double>::digits;

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

Route PixelRoute::route() {
  Route route;
  route.method = "GET";
  route.path = "/api/v1/live/pixel";
  route.role = Role::Viewer;
  route.description =
      "Returns the values at a pixel of a picture of the live stream: direction, intensity, "
      "temperature where a radiometric camera sees it, and the place on the scene; deg, %, degC, "
      "mm. 410: the picture is not kept, request a newer one";
  route.type = kJson;
  route.view = ViewArgument::One;
  route.query = {{"number", "Number of the picture in the stream; default: the next one"},
                 {"u", "px, to the right, pixel centres at integers", true},
                 {"v", "px, down", true}};
  route.serve = [this](const ExchangePtr& exchange) { serve(exchange); };
  return route;
}

void PixelRoute::serve(const ExchangePtr& exchange) {
  const std::string* name = exchange->request().argument("view");
  const auto named = name ? std::ranges::find(names_, *name) : names_.end();
  if (named == names_.end()) {
    exchange->answer(
        error_response(404, "unknown view; pass ?view=NAME with a name from /api/v1/status"));
    return;
  }
  const auto question = question_of(exchange, static_cast<std::size_t>(named - names_.begin()));
  if (!question) {
    exchange->answer(error_response(400, question.error().message));
    return;
  }
  recent_.point(question->view, hal::Clock::now());
  if (!question->number) return wait(*question);
  const ViewPtr view = recent_.find(question->view, *question->number);
  if (view) return answer(*question, *view, *question->number);
  exchange->answer(error_response(410, gone(*question->number, *name)));
}

Result<PixelRoute::Question> PixelRoute::question_of(const ExchangePtr& exchange,
                                                     std::size_t view) const {
  const Request& request = exchange->request();
  const auto number = number_of(request, "number", 0, 1, kMostNumber);
  const auto u = number_of(request, "u", 0, kMaxSide), v = number_of(request, "v", 0, kMaxSide);
  for (const auto* argument : {&number, &u, &v}) {
    if (!*argument) return tl::unexpected(argument->error());
  }
  Question question{exchange, view, std::nullopt, {*u, *v}};
  if (*number > 0) question.number = static_cast<std::uint64_t>(*number);
  return question;
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
  const int width = view.picture.width, height = view.picture.height;
  if (question.pixel.u > width - 1 || question.pixel.v > height - 1) {
    question.exchange->answer(error_response(400, "the picture has " + std::to_string(width) + "x" +
                                                      std::to_string(height) + " pixels"));
    return;
  }
  const auto projection = projection_of(view, views_[view.index]);
  if (!projection) {
    question.exchange->answer(error_response(409, projection.error().message));
    return;
  }
  const Pixel pixel = pixel_of(view, *projection, ball_, scene_, question.pixel);
  question.exchange->answer(json_response(pixel_json(pixel, number, view.stamp)));
}

}  // namespace orbwatch::app::web
