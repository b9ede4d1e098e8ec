// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <mutex>
#include <optional>
#include <vector>

#include "app/alignment/aligned_site.h"
#include "app/alignment/alignment_proposal.h"
#include "app/alignment/point_marks.h"
#include "app/alignment/watched_cameras.h"
#include "app/model/alignment/alignment.h"

namespace orbwatch::app {

/// Finds alignments of a running site's cameras by their next pictures, which takes seconds. `rig`
/// is the one in force or proposed: an alignment keeps the rest of it. Every camera is watched.
/// Thread rule: one caller at a time; points() on any thread.
class AlignmentFinder {
 public:
  /// Both outlive it.
  AlignmentFinder(const AlignedSite& site, WatchedCameras& watch) : site_(site), watch_(watch) {}

  /// Alignment by the ball in the picture.
  Result<AlignmentProposal> detect(const optics::Rig& rig, std::size_t camera) const;
  /// Registration to the first camera; one that is refused is tried again with the next pictures.
  Result<AlignmentProposal> register_to_first(const optics::Rig& rig, std::size_t camera) const;
  /// Alignment that the drift asks for.
  Result<AlignmentProposal> correct(const optics::Rig& rig, std::size_t camera) const;

  /// Adds a point where the ball shows the tool's light now, or at `pixel`.
  Result<> mark(const optics::Rig& rig, std::size_t camera, const optics::Vec3& point,
                const std::optional<optics::Vec2>& pixel);
  /// False: no point has these coordinates.
  bool forget_point(std::size_t camera, const optics::Vec3& point);
  void forget_points(std::size_t camera);
  /// Placement by the camera's points and the site's tags.
  Result<AlignmentProposal> place(const optics::Rig& rig, std::size_t camera);

  /// Marked points, with their residuals in the newest placement.
  std::vector<PlacedPoint> points(std::size_t camera) const;

 private:
  Result<AlignmentProposal> register_by(const optics::Rig& rig, std::size_t camera,
                                        const std::vector<RecordedPicture>& of_first,
                                        const std::vector<RecordedPicture>& of_camera) const;
  Result<align::PlaceRequest> request_for(const optics::Rig& rig, std::size_t camera) const;
  void show(std::size_t camera, std::vector<PlacedPoint> points);

  const AlignedSite& site_;
  WatchedCameras& watch_;
  std::array<PointMarks, kMaxCameras> points_;
  mutable std::mutex mutex_;
  std::array<std::vector<PlacedPoint>, kMaxCameras> shown_;  ///< under mutex_
};

}  // namespace orbwatch::app
