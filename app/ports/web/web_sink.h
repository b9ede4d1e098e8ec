// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "app/model/sink.h"
#include "app/ports/web/access/access.h"
#include "app/ports/web/access/access_desk.h"
#include "app/ports/web/access/audit.h"
#include "app/ports/web/align/align_routes.h"
#include "app/ports/web/commands/command_runner.h"
#include "app/ports/web/configuration/configuration_desk.h"
#include "app/ports/web/history/history_routes.h"
#include "app/ports/web/http/server.h"
#include "app/ports/web/listeners.h"
#include "app/ports/web/look_around/look_around.h"
#include "app/ports/web/pixels/pixel_route.h"
#include "app/ports/web/process/recipe_routes.h"
#include "app/ports/web/routes.h"
#include "app/ports/web/status/web_statistics.h"
#include "app/ports/web/streams/mjpeg_stream.h"
#include "app/ports/web/streams/view_encoder.h"
#include "app/ports/web/views/view_list.h"
#include "app/ports/web/web_context.h"
#include "app/ports/web/web_settings.h"
#include "hal/thread/priority_mutex.h"
#include "hal/thread/thread.h"

namespace orbwatch::app {

/// Serves status, pictures and commands over HTTP: see README.md for the paths. Requests are
/// answered on the server's threads, pictures compressed on shared ones; the pipeline only stores a
/// status and a picture. Thread rule: as Sink; port and statistics on any thread while it is
/// started.
class WebSink final : public Sink {
 public:
  WebSink(WebSettings settings, const WebContext& context);
  ~WebSink() override;

  /// Does nothing when disabled or running. Errors: those of Listeners::open(); it may be repeated.
  Result<> start() override;
  void stop() override;
  std::chrono::nanoseconds cpu_time() const override;

  PictureNeeds needs(std::size_t view, hal::TimePoint stamp) override;
  KeptViews keeps() const override;
  void accept(const ViewPtr& view) override;
  void accept(const Status& status) override;
  void accept_event(const AlarmNotice& notice) override { history_.accept(notice); }

  int port() const { return listeners_.port(); }
  int https_port() const { return listeners_.https_port(); }
  web::WebStatistics statistics() const;
  const std::vector<web::Route>& routes() const { return routes_; }

 private:
  struct NewestStatus {
    Status status;
    std::chrono::system_clock::time_point utc{};
    hal::TimePoint received;
  };

  std::vector<web::Route> make_routes();
  std::vector<web::Route> make_command_routes();
  void run_command(const CommandInfo& info, const web::ExchangePtr& exchange);
  void begin();
  void pass_on(const web::ExchangePtr& exchange);
  void watch();
  std::string newest_as_json() const;
  NewestStatus newest() const;
  void serve_health(const web::ExchangePtr& exchange) const;
  void serve_status(const web::ExchangePtr& exchange) const;
  void serve_description(const web::ExchangePtr& exchange) const;
  void serve_metrics(const web::ExchangePtr& exchange) const;
  void serve_snapshot(const web::ExchangePtr& exchange) const;
  void serve_stream(const web::ExchangePtr& exchange);
  void serve_live(const web::ExchangePtr& exchange);
  void start_stream(const web::ExchangePtr& exchange, web::Credentials credentials,
                    std::string_view type, std::shared_ptr<web::Stream> stream);
  const web::ViewEncoder* find_view(const std::string* name,
                                    const web::ExchangePtr& exchange) const;

  const WebSettings settings_;
  const StatusNames names_;
  const std::shared_ptr<hal::SharedThreads> threads_;
  std::atomic<bool> is_running_{false};

  web::ViewList list_;
  web::PixelRoute pixels_;
  std::vector<std::unique_ptr<web::ViewEncoder>> views_;  ///< encoders by View::index
  /// Indexed by view: the next picture has readers; used by accept()'s thread only.
  std::vector<bool> asked_;

  mutable hal::PriorityMutex mutex_;
  NewestStatus newest_;  ///< guarded by mutex_

  /// Status as JSON for streams, made on thread_ while a stream reads it.
  const std::shared_ptr<web::Feed> status_feed_ = std::make_shared<web::Feed>();

  web::ServerCounts server_counts_;
  web::StreamCounts stream_counts_;
  web::CommandRunner commands_;
  web::LookAround look_around_;
  web::AlignRoutes align_;
  web::RecipeRoutes recipe_;
  web::HistoryRoutes history_;
  web::Audit audit_;
  web::Access access_;
  web::AccessDesk desk_;
  web::ConfigurationDesk configuration_;
  const Program program_;
  const std::shared_ptr<Fleet> fleet_;
  const std::function<std::vector<InterfaceTable>()> tables_;
  const std::function<std::vector<InterfaceMetric>()> metrics_;
  const std::vector<web::Route> routes_;
  web::Listeners listeners_;
  hal::Thread thread_;  ///< ends overdue connections, reports to streams, keeps history
};

}  // namespace orbwatch::app
