// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "app/pipeline/views/view_plan.h"
#include "app/pipeline/views/view_renderer.h"
#include "hal/thread/priority_mutex.h"
#include "hal/thread/shared_threads.h"
#include "proc/image/result.h"
#include "proc/optics/rotation.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app::pipeline {

/// Direction and field of view, degrees: all of a ViewSpec but its kind and size, which a view
/// keeps.
struct Pointing {
  optics::YawPitchRoll orientation;
  std::optional<double> h_fov;
  std::optional<double> v_fov;
};

/// Points display views elsewhere while frames run: compiles renderers on a shared thread, off the
/// frame path, which exchanges them between two frame sets. Queues per view: one request and
/// one compiled renderer; the newest wins, each one replaced before its use is counted.
/// Thread rule: point, turn, mix, adopt and superseded on any thread, exchange on the pipeline's,
/// stop on the main.
class PanTiltZoom {
 public:
  using Threads = std::shared_ptr<hal::SharedThreads>;

  /// `views`, by index, outlive this.
  explicit PanTiltZoom(std::span<const ViewPlan> views,
                       Threads threads = hal::SharedThreads::alone());
  ~PanTiltZoom();
  PanTiltZoom(const PanTiltZoom&) = delete;
  PanTiltZoom& operator=(const PanTiltZoom&) = delete;

  /// Requests a view of the same kind and size that looks elsewhere, without waiting for it.
  /// Returns the request's number, from 1 in each view; View::pointing reaches or passes it with
  /// the first frame that shows it or a newer one. Error: no such view; what optics::check_view()
  /// refuses; after stop().
  Result<std::uint64_t> point(std::size_t view, const Pointing& pointing);

  /// As point(), but keeps the roll and, where `h_fov` is 0, the field of view. Degrees.
  Result<std::uint64_t> turn(std::size_t view, double yaw, double pitch, double h_fov);

  /// Requests another weight of one of the view's sources. Returns and errors as point(); no such
  /// source, a weight that is not above 0.
  Result<std::uint64_t> mix(std::size_t view, std::size_t source, double weight);

  /// Requests the view with other `sources` in place of its own, of the same cameras, with the
  /// weights that those have now. Error: after stop().
  Result<> adopt(std::size_t view, std::vector<ViewSource> sources);

  /// Between two frame sets: swaps the renderer in use for the one compiled since, if there is one.
  /// Waits for no compilation, neither allocates nor frees: the thread frees the old one.
  void exchange(std::size_t view, std::unique_ptr<ViewRenderer>& in_use);

  /// Number of requests of a view that a newer one replaced before exchange().
  std::uint64_t superseded(std::size_t view) const;

  /// Waits for the compilation under way, and drops waiting requests; repeating it does nothing.
  void stop();

 private:
  /// All that a request can change.
  struct Aim {
    Pointing pointing;
    std::vector<ViewSource> sources;
  };
  struct Request {
    optics::ViewProjection projection;
    std::vector<ViewSource> sources;
    std::uint64_t number;
  };
  struct Slot {
    Aim aim;                     ///< of the newest request, or as configured; under requesting_
    std::uint64_t requests = 0;  ///< under requesting_
    std::optional<Request> request;
    std::unique_ptr<ViewRenderer> renderer;  ///< for exchange() if `compiled`, else to be freed
    bool compiled = false;
    std::uint64_t superseded = 0;
  };
  struct Work {
    std::size_t view;
    std::optional<Request> request;  ///< nullopt: a renderer was to be freed
  };

  template <class Change>
  Result<std::uint64_t> request(std::size_t view, const Change& change);
  void compile_all();
  std::optional<Work> next_work(std::size_t last);
  void compile(std::size_t view, const Request& request);

  const std::span<const ViewPlan> views_;
  std::mutex requesting_;  ///< held while a request is made: each one changes the one before
  mutable hal::PriorityMutex mutex_;  ///< the frame path locks it: never held across work
  std::vector<Slot> slots_;           ///< by view
  bool stopped_ = false;
  std::size_t last_ = 0;  ///< view that was compiled last; of the work
  hal::SharedThreads::Work compiler_;
};

}  // namespace orbwatch::app::pipeline
