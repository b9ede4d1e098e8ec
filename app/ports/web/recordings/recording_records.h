// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/model/sink/recorded_events.h"
#include "proc/settings/settings.h"

/// Records of the recorder's events.
namespace orbwatch::app::web {

template <class Visitor>
void visit(Visitor& v, RecordedEvent& event) {
  v.required("name", event.name, "Name, for requests");
  v.required("trigger", event.trigger, "Kind of the trigger: alarm, command, laser_on or layer");
  v.required("cause", event.text, "Cause in words");
  v.required("first", event.first, "Time of the first frame set, UTC; empty: not known");
  v.required("triggered", event.triggered, "Time of the trigger's frame set, UTC");
  v.required("last", event.last, "Time of the last frame set, UTC");
  v.required("part", event.part, "Part that the machine stated; empty: not known");
  v.required("layer", event.layer, "Layer of the part; null: not known");
  v.required("pictures", event.pictures, "Number of pictures of all cameras");
  v.required("lost", event.lost, "Pictures that found no room");
  v.required("bytes", event.bytes, "Size on the disk; of an event that is being recorded, less",
             "B");
  v.required("is_pinned", event.is_pinned, "It is not deleted for room");
  v.required("is_finished", event.is_finished, "False: it is being recorded");
  v.required("has_beginning", event.has_beginning,
             "False: pictures before the trigger are missing");
  v.required("is_interrupted", event.is_interrupted, "It was not recorded to its end");
}

struct RecordingsAnswer {
  std::vector<RecordedEvent> events;
  std::optional<std::string> missing;
};
template <class Visitor>
void visit(Visitor& v, RecordingsAnswer& answer) {
  v.required("events", answer.events, "The newest first");
  v.required("missing", answer.missing, "Key that recording needs; null: none");
}

struct EventQuery {
  std::string event;
};
template <class Visitor>
void visit(Visitor& v, EventQuery& query) {
  v.required("event", query.event, "Name of the event");
}

template <class Visitor>
void visit(Visitor& v, RecordedFrames& frames) {
  v.required("camera", frames.camera, "Name of the camera");
  v.required("times", frames.times, "Times of the pictures' frame sets, UTC, ascending");
}

struct FramesAnswer {
  std::vector<RecordedFrames> cameras;
};
template <class Visitor>
void visit(Visitor& v, FramesAnswer& answer) {
  v.required("cameras", answer.cameras, "Pictures by camera");
}

struct FrameQuery {
  std::string event;
  std::string camera;
  int frame = 0;
};
template <class Visitor>
void visit(Visitor& v, FrameQuery& query) {
  v.required("event", query.event, "Name of the event");
  v.required("camera", query.camera, "Name of the camera");
  v.required("frame", query.frame, Range::between(0, 1e6), "Number of the picture, from 0");
}

struct PinBody {
  std::string event;
  bool is_pinned = true;
};
template <class Visitor>
void visit(Visitor& v, PinBody& pin) {
  v.required("event", pin.event, "Name of the event");
  v.required("is_pinned", pin.is_pinned, "True: it is not deleted for room");
}

}  // namespace orbwatch::app::web
