// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/streams/stream_routes.h"

#include <algorithm>
#include <utility>

#include "app/ports/web/streams/mjpeg_stream.h"

namespace orbwatch::app::web {

StreamRoutes::StreamRoutes(const std::vector<std::string>& names,
                           const std::vector<PublishedView>& views,
                           const std::vector<PictureSource>& others, const JpegSettings& jpeg,
                           int max_streams, const std::shared_ptr<hal::SharedThreads>& threads,
                           std::shared_ptr<Feed> status, const ViewEncoder::OnPicture& on_picture,
                           Access& access, ServerCounts& counts)
    : max_streams_(static_cast<std::uint64_t>(max_streams)),
      status_(std::move(status)),
      access_(access),
      server_counts_(counts),
      asked_(names.size()) {
  views_.reserve(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    views_.push_back(std::make_unique<ViewEncoder>(jpeg, threads, on_picture));
    sources_.push_back({names[i], views[i].spec.width, views_.back()->feeds()});
  }
  sources_.insert(sources_.end(), others.begin(), others.end());
  for (const PictureSource& source : sources_) names_.push_back(source.name);
}

Answered<std::shared_ptr<Feed>> StreamRoutes::feed_of(const std::string& name, int width) const {
  return index_of("view", name, names_).map([&](std::size_t i) {
    return sources_[i].feeds.of(size_for(width, sources_[i].width));
  });
}

void StreamRoutes::snapshot(const PictureQuery& query, const ExchangePtr& exchange) const {
  auto feed = feed_of(query.view, query.width);
  if (feed) return (*feed)->answer_next(exchange);
  exchange->answer(std::move(feed.error()));
}

Response StreamRoutes::stream(const PictureQuery& query, const Request& request) {
  auto feed = feed_of(query.view, query.width);
  if (!feed) return std::move(feed.error());
  return start(player_credentials_of(request), MjpegStream::kType,
               std::make_shared<MjpegStream>(*feed, counts_));
}

/// Serves each view once, in the first of its widths, however often it is named.
Response StreamRoutes::live(const LiveQuery& query, const Request& request) {
  std::vector<LiveStream::Source> sources{{"", status_}};
  for (std::size_t i = 0; i < query.view.size(); ++i) {
    const std::string& name = query.view[i];
    auto feed = feed_of(name, query.width.empty() ? 0 : query.width[i]);
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
  for (const auto& view : views_) {
    statistics.pictures_replaced += view->replaced();
    statistics.pictures_compressed += view->compressed_pictures();
  }
}

}  // namespace orbwatch::app::web
