#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include "app/pipeline/view_renderer.h"
#include "proc/image/result.h"
#include "proc/optics/rotation.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app {

/// Where a view looks: all of a ViewSpec but its kind and size, which a view keeps. Degrees.
struct Pointing {
  optics::YawPitchRoll orientation;
  std::optional<double> h_fov;
  std::optional<double> v_fov;
};

/// A renderer and the request that it answers.
struct PointedRenderer {
  std::unique_ptr<ViewRenderer> renderer;
  std::uint64_t pointing = 0;  ///< see View::pointing
};

/// Points views elsewhere while frames run: compiles renderers on its own thread, off the frame
/// path, which takes them over between two frames. Queues per view: one request and one compiled
/// renderer; the newest wins, each one that was replaced before it was used is counted.
/// Thread rule: point and superseded on any thread, exchange on the pipeline's, stop on the main.
class PanTiltZoom {
 public:
  /// `views`, by index, outlive this. Starts the thread.
  explicit PanTiltZoom(std::span<const ViewPlan> views);
  ~PanTiltZoom();
  PanTiltZoom(const PanTiltZoom&) = delete;
  PanTiltZoom& operator=(const PanTiltZoom&) = delete;

  /// Asks for a view of the same kind and size that looks elsewhere. Does not wait for it: returns
  /// the request's number, from 1 in each view, which View::pointing reaches or passes with the
  /// first frame that shows it or a newer one. Error: no such view; what optics::check_view()
  /// refuses; after stop().
  Result<std::uint64_t> point(std::size_t view, const Pointing& pointing);

  /// The same for a view that keeps its roll and, where `h_fov` is 0, its field of view. Degrees.
  Result<std::uint64_t> turn(std::size_t view, double yaw, double pitch, double h_fov);

  /// Asks for another weight of one of the view's sources. Returns and errors as point(); no such
  /// source, a weight that is not above 0.
  Result<std::uint64_t> mix(std::size_t view, std::size_t source, double weight);

  /// Between two frames: replaces what is `shown`, by view, with what has been compiled since.
  /// Waits for no compilation, neither allocates nor frees: the thread frees what was replaced.
  void exchange(std::span<PointedRenderer> shown);

  /// How many requests of a view were replaced by a newer one before exchange() took them over.
  std::uint64_t superseded(std::size_t view) const;

  /// Ends the thread, after the compilation under way, and drops what waits; repeating it does
  /// nothing.
  void stop();

 private:
  /// All that can be asked for.
  struct Aim {
    Pointing pointing;
    std::vector<double> weights;  ///< by source
  };
  struct Request {
    optics::ViewProjection projection;
    std::vector<double> weights;
    std::uint64_t number;
  };
  struct Slot {
    Aim aim;                     ///< of the newest request, or as configured; under asking_
    std::uint64_t requests = 0;  ///< under asking_
    std::optional<Request> request;
    PointedRenderer renderer;  ///< to be shown if `compiled`, else to be freed
    bool compiled = false;
    std::uint64_t superseded = 0;
  };
  struct Work {
    std::size_t view;
    std::optional<Request> request;  ///< nothing: only a renderer was to be freed
  };

  template <class Change>
  Result<std::uint64_t> ask(std::size_t view, const Change& change);
  void run();
  std::optional<Work> take_work(std::size_t last);
  void compile(std::size_t view, const Request& request);

  const std::span<const ViewPlan> views_;
  std::mutex asking_;         ///< held while a request is made, so that none loses another's
  mutable std::mutex mutex_;  ///< the frame path takes it: held for no work
  std::condition_variable work_;
  std::vector<Slot> slots_;  ///< by view
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace orbwatch::app
