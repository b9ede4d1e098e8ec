// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/model/sink/published.h"
#include "app/model/sink/view.h"
#include "app/ports/web/access/access.h"
#include "app/ports/web/api/route.h"
#include "app/ports/web/http/exchange.h"
#include "app/ports/web/http/server.h"
#include "app/ports/web/status/web_statistics.h"
#include "app/ports/web/streams/live_stream.h"
#include "app/ports/web/streams/picture_feeds.h"
#include "app/ports/web/streams/stream_counts.h"
#include "app/ports/web/streams/view_encoder.h"
#include "app/ports/web/streams/view_query.h"
#include "hal/thread/shared_threads.h"

namespace orbwatch::app::web {

/// A request for the status and any views.
struct LiveQuery {
  std::vector<std::string> view;
  std::vector<int> width;
};
template <class Visitor>
void visit(Visitor& v, LiveQuery& query) {
  v.optional("view", query.view, "Names of views, each as an argument of its own");
  v.optional(
      "width", query.width, kShownWidths,
      "Widths at which they are displayed, one for each view in their order, or none; as for "
      "/stream.mjpg",
      "px");
  v.require(query.width.empty() || query.width.size() == query.view.size(),
            "width must be there once for each view, in their order, or not at all");
}

/// Compresses the pictures of views while they have readers, and serves them. Thread rule: wants
/// and accept on the pipeline's thread; stop by the owner; everything else on any thread.
class StreamRoutes {
 public:
  /// `views` by their index, like `names`. `others` are served beside them. `max_streams` is the
  /// limit of open streams. `status` is the feed of the status. `on_picture` as for ViewEncoder.
  /// `access` and `counts` outlive the routes.
  StreamRoutes(const std::vector<std::string>& names, const std::vector<PublishedView>& views,
               const std::vector<PictureSource>& others, const JpegSettings& jpeg, int max_streams,
               const std::shared_ptr<hal::SharedThreads>& threads, std::shared_ptr<Feed> status,
               const ViewEncoder::OnPicture& on_picture, Access& access, ServerCounts& counts);

  void snapshot(const PictureQuery& query, const ExchangePtr& exchange) const;
  Response stream(const PictureQuery& query, const Request& request);
  Response live(const LiveQuery& query, const Request& request);

  /// Returns whether the picture of this moment has readers or is wanted otherwise; accept() takes
  /// it only then.
  bool wants(std::size_t view, hal::TimePoint stamp, bool is_wanted);
  void accept(const ViewPtr& view);
  void stop();

  std::chrono::nanoseconds cpu_time() const;
  /// Adds the counters of the streams.
  void count(WebStatistics& statistics) const;

 private:
  /// Feed of the pictures of that name for clients that display them in this width, px; 0: full
  /// size.
  Answered<std::shared_ptr<Feed>> feed_of(const std::string& name, int width) const;
  Response start(Credentials credentials, std::string_view type, std::shared_ptr<Stream> stream);

  const std::uint64_t max_streams_;
  const std::shared_ptr<Feed> status_;
  Access& access_;
  ServerCounts& server_counts_;
  StreamCounts counts_;
  std::vector<std::unique_ptr<ViewEncoder>> views_;  ///< encoders by View::index
  std::vector<PictureSource> sources_;               ///< pictures of views and others
  std::vector<std::string> names_;                   ///< names of sources_
  /// Flags by view: the next picture has readers; used on the pipeline's thread only.
  std::vector<bool> asked_;
};

}  // namespace orbwatch::app::web
