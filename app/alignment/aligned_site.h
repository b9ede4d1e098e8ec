// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/model/alignment/accepted_alignments.h"
#include "app/model/alignment/place_settings.h"
#include "app/model/alignment/watch_settings.h"
#include "proc/optics/rig.h"
#include "proc/signals/signals.h"

namespace orbwatch::app {

/// A camera of a running site.
struct AlignedCamera {
  std::string name;
  std::size_t in_rig = 0;  ///< its place in AlignedSite::rig
  WatchSettings watch;
};

/// A running site's cameras with the alignments that are in force.
struct AlignedSite {
  std::vector<AlignedCamera> cameras;
  optics::Rig rig;
  std::vector<CalibrationEntry> alignments;  ///< in force in place of the rig file's
  PlaceSettings place;
  double work_distance = signals::kNotValid;  ///< see work_distance()

  /// Error at the work piece, mm, of directions that are wrong by `direction_sigma` degrees.
  double work_sigma(double direction_sigma) const {
    return work_distance * optics::radians(direction_sigma);
  }
  const optics::RigCamera& rig_camera(std::size_t camera) const { return camera_of(rig, camera); }
  /// The same camera in another state of the rig.
  const optics::RigCamera& camera_of(const optics::Rig& other, std::size_t camera) const {
    return other.cameras[cameras[camera].in_rig];
  }
};

}  // namespace orbwatch::app
