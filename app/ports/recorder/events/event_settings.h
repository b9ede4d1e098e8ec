// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "proc/settings/settings.h"

namespace orbwatch::app::recorder {

/// The [recorder.events] part of the site file.
struct EventSettings {
  int ring_mib = 0;  ///< memory for the pictures that wait
  std::chrono::milliseconds before{5000};
  std::chrono::milliseconds after{5000};
  std::chrono::milliseconds longest{60000};  ///< of an event that triggers extend
  bool on_alarm = true;
  bool on_laser = false;
  bool on_layer = false;
  std::vector<std::string> on_lines;  ///< names of process inputs
  std::vector<std::string> cameras;   ///< names; none: all
  int quality = 90;                   ///< of JPEG
  bool lossless = false;
  int keep_days = 0;  ///< 0: as long as there is room
  int line = 0;       ///< line of the table in its file, for messages
};

template <class Visitor>
void visit(Visitor& v, EventSettings& events) {
  v.line(events.line);
  v.required("ring_mib", events.ring_mib, Range::between(1, 65536),
             "Memory for the pictures that wait for a trigger or for the disk, MiB. It must hold "
             "before_s and after_s together; a picture costs the bytes of the ball's part, such "
             "as 0.6 MiB of 640x512 with 16 bit");
  v.optional("before_s", events.before, Seconds{Range::between(0, 600)},
             "Time before the trigger that an event begins, s");
  v.optional("after_s", events.after, Seconds{Range::between(0, 600)},
             "Time after the trigger that it ends, s");
  v.optional("longest_s", events.longest, Seconds{Range::between(1, 3600)},
             "Limit of an event that further triggers extend, s; the next one is an event of its "
             "own. At least twice before_s and after_s together");
  v.require(events.longest >= 2 * (events.before + events.after), "longest_s",
            "must be at least twice before_s and after_s together");
  v.optional("on_alarm", events.on_alarm, "Record an event when an alarm is raised");
  v.optional("on_laser", events.on_laser, "Record an event when the machine's laser goes on");
  v.optional("on_layer", events.on_layer, "Record an event when the machine's layer changes");
  v.optional("on_lines", events.on_lines,
             "Names of lines with use process_input: record an event when one becomes active");
  v.optional("cameras", events.cameras, "Cameras whose pictures are recorded; default: all");
  v.optional(
      "quality", events.quality, Range::between(1, 100),
      "JPEG quality of 8-bit pictures; 16-bit ones are always lossless, and those of cameras "
      "that send JPEG stay as they were sent, whole");
  v.optional("lossless", events.lossless, "Record 8-bit pictures lossless, too, instead of JPEG");
  v.optional(
      "keep_days", events.keep_days, Range::between(0, 36500),
      "Age above which an event that is not pinned is deleted, days; 0: it is kept as long as "
      "there is room");
}

}  // namespace orbwatch::app::recorder
