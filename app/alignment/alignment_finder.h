// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/alignment/aligned_site.h"
#include "app/alignment/alignment_proposal.h"
#include "app/alignment/point_marks.h"
#include "app/alignment/watched_cameras.h"
#include "app/model/alignment/alignment.h"
#include "proc/align/work_progress.h"

namespace orbwatch::app {

/// Points marked for a camera, and how users are shown them: with their residuals in the newest
/// placement.
struct MarkedPoints {
  PointMarks marks;
  std::vector<PlacedPoint> shown;
};

/// Result of finding, which has changed nothing yet.
struct Found {
  std::optional<AlignmentProposal> proposal{};  ///< none: a point is marked
  std::optional<MarkedPoints> points{};         ///< of the camera from now on; none: as before
  std::string refusal{};                        ///< why its points give no alignment; else empty
};

/// Finds alignments of a running site's cameras by their next pictures, which takes seconds. `rig`
/// is the one in force or proposed: an alignment keeps the rest of it. Every camera is watched.
/// Error, besides those of the method: cancelled by `progress`. Thread rule: one caller at a time
/// finds; points, which are set and forgotten, on any thread.
class AlignmentFinder {
 public:
  /// Both outlive it.
  AlignmentFinder(const AlignedSite& site, WatchedCameras& watch) : site_(site), watch_(watch) {}

  /// Alignment by the ball in the picture.
  Result<Found> detect(const optics::Rig& rig, std::size_t camera,
                       const align::WorkProgress& progress) const;
  /// Registration to the first camera; one that is refused is tried again with the next pictures.
  Result<Found> register_to_first(const optics::Rig& rig, std::size_t camera,
                                  const align::WorkProgress& progress) const;
  /// Alignment that the drift asks for: of the camera as it is in force, which the drift is
  /// measured against, whatever is proposed.
  Result<Found> correct(std::size_t camera) const;

  /// The points with one more, where the ball shows the tool's light now, or at `pixel`.
  Result<Found> mark(const optics::Rig& rig, std::size_t camera, const optics::Vec3& point,
                     const std::optional<optics::Vec2>& pixel,
                     const align::WorkProgress& progress) const;
  /// Placement by the camera's points and the site's tags.
  Result<Found> place(const optics::Rig& rig, std::size_t camera,
                      const align::WorkProgress& progress) const;

  void set_points(std::size_t camera, MarkedPoints points);
  /// False: no point has these coordinates.
  bool forget_point(std::size_t camera, const optics::Vec3& point);
  void forget_points(std::size_t camera);
  std::vector<PlacedPoint> points(std::size_t camera) const;

 private:
  Result<AlignmentProposal> register_by(const optics::Rig& rig, std::size_t camera,
                                        const std::vector<RecordedPicture>& of_first,
                                        const std::vector<RecordedPicture>& of_camera,
                                        const align::WorkProgress& progress) const;
  Result<align::PlaceRequest> request_for(const optics::Rig& rig, std::size_t camera,
                                          const PointMarks& marks,
                                          const align::WorkProgress& progress) const;
  PointMarks marks_of(std::size_t camera) const;

  const AlignedSite& site_;
  WatchedCameras& watch_;
  mutable std::mutex mutex_;
  std::array<MarkedPoints, kMaxCameras> points_;  ///< under mutex_
};

}  // namespace orbwatch::app
