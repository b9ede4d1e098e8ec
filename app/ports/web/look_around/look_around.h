// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/model/published.h"
#include "app/model/status_report.h"
#include "app/ports/web/http/exchange.h"
#include "app/ports/web/routes.h"
#include "hal/thread/shared_threads.h"

namespace orbwatch::app::web {

/// Serves the data from which browsers draw views of the room from a ball's picture. A mesh is
/// computed at the first request, on shared threads, and kept, because calibration and scene change
/// only with a restart. Thread rule: stop by the owner; the routes on any thread.
class LookAround {
 public:
  LookAround(const StatusNames& names, const std::vector<PublishedView>& views,
             std::shared_ptr<hal::SharedThreads> threads);

  std::vector<Route> routes();

  /// Waits for the computation in progress; pending requests are left to their deadline.
  void stop() { work_.cancel(); }
  std::chrono::nanoseconds cpu_time() const { return work_.cpu_time(); }

 private:
  struct Sphere {
    std::string name;  ///< name of the view
    std::shared_ptr<const optics::ViewProjection> view;
    Bytes mesh;                        ///< null: not computed yet; guarded by mutex_
    std::string tag;                   ///< ETag of the mesh; guarded by mutex_
    std::vector<ExchangePtr> waiting;  ///< under mutex_
  };

  void serve_list(const ExchangePtr& exchange) const;
  void serve_mesh(const ExchangePtr& exchange);
  void compute();
  static void answer(const ExchangePtr& exchange, const Bytes& mesh, const std::string& tag);

  std::string list_;  ///< answer of serve_list()
  std::mutex mutex_;
  std::vector<Sphere> spheres_;
  hal::SharedThreads::Work work_;
};

}  // namespace orbwatch::app::web
