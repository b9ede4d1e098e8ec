// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "app/model/sink/published.h"
#include "app/model/status/status_report.h"
#include "app/ports/web/api/route.h"
#include "app/ports/web/http/exchange.h"
#include "app/ports/web/look_around/ball_pictures.h"
#include "app/ports/web/streams/view_query.h"
#include "hal/thread/shared_threads.h"

namespace orbwatch::app::web {

/// Pictures of balls, and views that the command point_view points.
struct LookAroundAnswer {
  struct Pointed {
    std::string name;
    std::size_t index = 0;
  };
  std::vector<std::string> spheres;
  std::vector<Pointed> pointed;
};
template <class Visitor>
void visit(Visitor& v, LookAroundAnswer::Pointed& view) {
  v.required("name", view.name, "Name of the view");
  v.required("index", view.index, "Argument view of commands");
}
template <class Visitor>
void visit(Visitor& v, LookAroundAnswer& answer) {
  v.required(
      "spheres", answer.spheres,
      "Names of views of kind ball, and ball:CAMERA for cameras that none shows; streams and "
      "snapshots accept both as views");
  v.required("pointed", answer.pointed, "Views that point_view points");
}

/// Serves the data from which browsers draw views of the room from a ball's picture. A mesh is
/// computed at the first request, on shared threads, and kept, because calibration and scene change
/// only with a restart. Thread rule: stop by the owner; list and mesh on any thread.
class LookAround {
 public:
  LookAround(const StatusNames& names, const std::vector<PublishedView>& views,
             const std::vector<BallPictures::Ball>& balls,
             std::shared_ptr<hal::SharedThreads> threads);

  static constexpr std::string_view kType = "application/octet-stream";

  Answered<LookAroundAnswer> list() const { return list_; }
  /// Answers with mesh_text() of a ball's picture.
  void mesh(const ViewQuery& query, const ExchangePtr& exchange);

  /// Waits for the computation in progress; pending requests are left to their deadline.
  void stop() { work_.cancel(); }
  std::chrono::nanoseconds cpu_time() const { return work_.cpu_time(); }

 private:
  struct Sphere {
    std::shared_ptr<const optics::ViewProjection> view;
    Bytes mesh;                        ///< null: not computed yet; guarded by mutex_
    std::string tag;                   ///< ETag of the mesh; guarded by mutex_
    std::vector<ExchangePtr> waiting;  ///< under mutex_
  };

  void compute();
  static void answer(const ExchangePtr& exchange, const Bytes& mesh, const std::string& tag);

  LookAroundAnswer list_;
  std::mutex mutex_;
  std::vector<Sphere> spheres_;  ///< in the order of list_.spheres
  hal::SharedThreads::Work work_;
};

}  // namespace orbwatch::app::web
