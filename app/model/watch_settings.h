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
             "Compare the camera's pictures with those of its alignment, beside the frame path");
  v.optional(
      "drift_warning", watch.drift.warning, Range::above(0, 90),
      "Error of the directions that views show, rms, deg: from there on the figure alignment "
      "warns");
  v.optional("drift_alarm", watch.drift.alarm, Range::above(0, 90), "The same for its alarm, deg");
  v.optional("correct", watch.correct,
             "Put the alignment in force that a lasting drift asks for, with a restart; else the "
             "command correct_alignment proposes it");
  v.optional(
      "blur_warning", watch.blur.warning, Range::between(0, 100),
      "Blur of what the ball reflects, sigma, px, from which the figure focus warns; 0: none");
  v.optional("blur_alarm", watch.blur.alarm, Range::between(0, 100), "The same for its alarm, px");
  v.optional("contamination_warning", watch.contamination.warning, Range::between(0, 100),
             "Share of the ball under dirt from which the figure cleanliness warns, %; 0: none");
  v.optional("contamination_alarm", watch.contamination.alarm, Range::between(0, 100),
             "The same for its alarm, %");
  v.require(watch.drift.alarm >= watch.drift.warning, "drift_alarm",
            "must not be below drift_warning");
}

}  // namespace orbwatch::app
