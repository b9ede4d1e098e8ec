// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/streams/stream_routes.h"

#include <algorithm>
#include <utility>

#include "app/ports/web/streams/mjpeg_stream.h"

namespace orbwatch::app::web {

StreamRoutes::StreamRoutes(std::vector<std::string> views, std::vector<LiveStream::Source> others,
                           const JpegSettings& jpeg, int max_streams,
                           const std::shared_ptr<hal::SharedThreads>& threads,
                           std::shared_ptr<Feed> status, const ViewEncoder::OnPicture& on_picture,
                           Access& access, ServerCounts& counts)
    : names_(std::move(views)),
      others_(std::move(others)),
      max_streams_(static_cast<std::uint64_t>(max_streams)),
      status_(std::move(status)),
      access_(access),
      server_counts_(counts),
      asked_(names_.size()) {
  views_.reserve(names_.size());
  for (std::size_t i = 0; i < names_.size(); ++i) {
    views_.push_back(std::make_unique<ViewEncoder>(jpeg, threads, on_picture));
  }
}

Answered<std::shared_ptr<Feed>> StreamRoutes::feed_of(const std::string& view) const {
  const auto other = std::ranges::find(others_, view, &LiveStream::Source::name);
  if (other != others_.end()) return other->feed;
  return index_of("view", view, names_).map([this](std::size_t i) { return views_[i]->feed(); });
}

void StreamRoutes::snapshot(const ViewQuery& query, const ExchangePtr& exchange) const {
  auto feed = feed_of(query.view);
  if (feed) return (*feed)->answer_next(exchange);
  exchange->answer(std::move(feed.error()));
}

Response StreamRoutes::stream(const ViewQuery& query, const Request& request) {
  auto feed = feed_of(query.view);
  if (!feed) return std::move(feed.error());
  return start(player_credentials_of(request), MjpegStream::kType,
               std::make_shared<MjpegStream>(*feed, counts_));
}

/// Serves each view once, however often it is named.
Response StreamRoutes::live(const LiveQuery& query, const Request& request) {
  std::vector<LiveStream::Source> sources{{"", status_}};
  for (const std::string& name : query.view) {
    auto feed = feed_of(name);
    if (!feed) return std::move(feed.error());
    if (std::ranges::find(sources, name, &LiveStream::Source::name) == sources.end()) {
      sources.push_back({name, *feed});
    }
  }
  return start(credentials_of(request), LiveStream::kType,
               std::make_shared<LiveStream>(std::move(sources), counts_));
}

Response StreamRoutes::start(Credentials credentials, std::string_view type,
                             std::shared_ptr<Stream> stream) {
  if (server_counts_.streams >= max_streams_) {
    ++server_counts_.full;
    return error_response(503, "all streams are in use; raise max_streams of [web]");
  }
  Response response;
  response.type = type;
  response.stream = std::move(stream);
  response.may_go_on = [this, credentials = std::move(credentials)] {
    return access_.caller(credentials).role >= Role::Viewer;
  };
  return response;
}

bool StreamRoutes::wants(std::size_t view, hal::TimePoint stamp, bool is_wanted) {
  if (view >= views_.size()) return false;
  asked_[view] = views_[view]->wants(stamp, is_wanted);
  return asked_[view];
}

void StreamRoutes::accept(const ViewPtr& view) {
  if (view->index < views_.size() && asked_[view->index]) views_[view->index]->accept(view);
}

void StreamRoutes::stop() {
  for (const auto& view : views_) view->stop();
}

std::chrono::nanoseconds StreamRoutes::cpu_time() const {
  std::chrono::nanoseconds time{0};
  for (const auto& view : views_) time += view->cpu_time();
  return time;
}

void StreamRoutes::count(WebStatistics& statistics) const {
  statistics.pictures_sent = counts_.sent;
  statistics.pictures_skipped = counts_.skipped;
  for (const auto& view : views_) statistics.pictures_replaced += view->replaced();
}

}  // namespace orbwatch::app::web
