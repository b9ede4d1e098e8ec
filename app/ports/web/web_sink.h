// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "app/model/sink/sink.h"
#include "app/ports/web/access/access.h"
#include "app/ports/web/access/access_desk.h"
#include "app/ports/web/access/audit/audit.h"
#include "app/ports/web/align/align_routes.h"
#include "app/ports/web/api/changes.h"
#include "app/ports/web/api/route.h"
#include "app/ports/web/commands/command_desk.h"
#include "app/ports/web/configuration/configuration_desk.h"
#include "app/ports/web/device/device_desk.h"
#include "app/ports/web/fleet/fleet_routes.h"
#include "app/ports/web/history/history_routes.h"
#include "app/ports/web/http/server.h"
#include "app/ports/web/interfaces/interface_routes.h"
#include "app/ports/web/listeners.h"
#include "app/ports/web/log/log_routes.h"
#include "app/ports/web/look_around/ball_pictures.h"
#include "app/ports/web/look_around/look_around.h"
#include "app/ports/web/machine/machine_desk.h"
#include "app/ports/web/pixels/pixel_route.h"
#include "app/ports/web/process/recipe_routes.h"
#include "app/ports/web/recordings/export_routes.h"
#include "app/ports/web/recordings/recording_routes.h"
#include "app/ports/web/recordings/replay_routes.h"
#include "app/ports/web/status/status_routes.h"
#include "app/ports/web/status/web_statistics.h"
#include "app/ports/web/streams/stream_routes.h"
#include "app/ports/web/views/view_list.h"
#include "app/ports/web/web_context.h"
#include "app/ports/web/web_settings.h"
#include "hal/thread/thread.h"

namespace orbwatch::app {

/// Owns the parts of the page and of the HTTP interface, whose list is routes.cpp, and passes them
/// status and pictures. Requests are answered on the server's threads, pictures compressed on
/// shared ones; the pipeline only stores a status and a picture. Thread rule: as Sink; port and
/// statistics on any thread while it is started.
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
  std::vector<web::Route> make_routes();
  DeviceFiles::Figures figures() const;
  void begin();
  void pass_on(const web::ExchangePtr& exchange);
  void watch();
  void follow_files();

  const WebSettings settings_;
  const std::shared_ptr<hal::SharedThreads> threads_;
  std::atomic<bool> is_running_{false};

  web::ServerCounts server_counts_;
  web::Audit audit_;
  web::Access access_;
  web::Changes access_changes_, file_changes_;
  web::Changes recording_changes_;
  web::Changes device_changes_;
  web::ViewList list_;
  web::PixelRoute pixels_;
  web::StatusRoutes status_;
  web::BallPictures balls_;
  web::StreamRoutes streams_;
  web::CommandDesk commands_;
  web::MachineDesk machine_;
  web::LookAround look_around_;
  web::AlignRoutes alignment_;
  web::RecipeRoutes recipe_;
  web::HistoryRoutes history_;
  web::LogRoutes log_;
  web::AccessDesk desk_;
  web::ConfigurationDesk configuration_;
  web::InterfaceRoutes interfaces_;
  web::FleetRoutes fleet_;
  web::RecordingRoutes recordings_;
  web::ExportRoutes exports_;
  web::ReplayRoutes replays_;
  web::DeviceDesk device_;
  const std::vector<web::Route> routes_;
  web::Listeners listeners_;
  hal::Thread thread_;        ///< ends overdue connections, reports to streams
  hal::Thread files_thread_;  ///< writes audit, history and certificate, reads changed users
};

}  // namespace orbwatch::app
