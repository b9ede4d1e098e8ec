// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/align/drift/drift_monitor.h"
#include "proc/settings/settings.h"

namespace orbwatch::app {

/// Values from which a figure warns and alarms; 0: never.
struct WatchLimits {
  double warning = 0;
  double alarm = 0;
};

/// Watching of a camera, and its limits.
struct WatchSettings {
  bool enabled = true;
  align::DriftLimits drift;
  bool correct = false;
  WatchLimits blur;                  ///< px
  WatchLimits contamination{5, 15};  ///< %
};

template <class Visitor>
void visit(Visitor& v, WatchSettings& watch) {
  v.optional("enabled", watch.enabled,
             "Compare the camera's pictures with those of its alignment, outside the frame path");
  v.optional(
      "drift_warning", watch.drift.warning, Range::above(0, 90),
      "Warning limit of the figure alignment: rms error of the directions that views show, deg");
  v.optional("drift_alarm", watch.drift.alarm, Range::above(0, 90),
             "Alarm limit of the figure alignment, deg");
  v.optional("correct", watch.correct,
             "Apply the correction of a lasting drift automatically, with a restart; false: only "
             "the command correct_alignment proposes it");
  v.optional("blur_warning", watch.blur.warning, Range::between(0, 100),
             "Warning limit of the figure focus: sigma of the reflection's blur, px; 0: none");
  v.optional("blur_alarm", watch.blur.alarm, Range::between(0, 100),
             "Alarm limit of the figure focus, px; 0: none");
  v.optional(
      "contamination_warning", watch.contamination.warning, Range::between(0, 100),
      "Warning limit of the figure cleanliness: share of the ball covered by dirt, %; 0: none");
  v.optional("contamination_alarm", watch.contamination.alarm, Range::between(0, 100),
             "Alarm limit of the figure cleanliness, %; 0: none");
  v.require(watch.drift.alarm >= watch.drift.warning, "drift_alarm",
            "must not be below drift_warning");
}

}  // namespace orbwatch::app
