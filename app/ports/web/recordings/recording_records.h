// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/model/sink/recorded_events.h"
#include "app/model/sink/recorded_regions.h"
#include "app/model/status/utc_text.h"
#include "proc/settings/settings.h"

/// Records of the recorder's events.
namespace orbwatch::app::web {

template <class Visitor>
void visit(Visitor& v, AlarmCause& alarm) {
  v.required("region", alarm.region, "Name of the region");
  v.required("signal", alarm.signal, "Name of the signal");
  v.required("level", alarm.level, "Limit that was reached");
  v.required("value", alarm.value, "Value of the signal; null: not measured");
  v.required("unit", alarm.unit, "Its unit");
}

template <class Visitor>
void visit(Visitor& v, RecordedEvent& event) {
  v.required("name", event.name, "Name, for requests");
  v.required("trigger", event.trigger,
             "Kind of the trigger: alarm, command, laser_on, layer or line");
  v.required("cause", event.text, "Cause in words");
  v.required("alarm", event.alarm,
             "The raised alarm; null: another cause, or an event of an earlier version");
  v.required("line", event.line,
             "Name of the digital line that became active; empty: another cause, or an event of an "
             "earlier version");
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

/// Events to list; an empty text or an unset layer is any.
struct RecordingsQuery {
  std::string trigger{}, part{};
  std::optional<double> layer{};
  std::string from{}, to{};  ///< UTC; the moments belong to the range
  std::string before{};      ///< name of an event that is newer than those
  int limit = 100;
};
template <class Visitor>
void visit(Visitor& v, RecordingsQuery& query) {
  v.optional("trigger", query.trigger, "Kind of the trigger; without it, all");
  v.optional("part", query.part, "Text that the name of the part contains; A to Z match a to z");
  v.optional("layer", query.layer, "Layer of the part");
  v.optional("from", query.from, "Earliest time of the trigger, UTC: 2026-11-28T09:22:00.125Z");
  v.optional("to", query.to, "Latest time of the trigger, UTC");
  v.optional("before", query.before, "Name of an event: only older ones");
  v.optional("limit", query.limit, Range::between(1, 1000), "Most events in an answer");
  for (const std::string* moment : {&query.from, &query.to}) {
    v.require(moment->empty() || parse_utc_text(*moment).has_value(),
              "from and to must be UTC such as 2026-11-28T09:22:00.125Z");
  }
}

struct RecordingsAnswer {
  std::vector<RecordedEvent> events;
  std::uint64_t total = 0;
  std::uint64_t matching = 0;
  bool has_older = false;
  std::optional<std::string> missing;
};
template <class Visitor>
void visit(Visitor& v, RecordingsAnswer& answer) {
  v.required("events", answer.events, "The newest first");
  v.required("total", answer.total, "Number of all events on the disk");
  v.required("matching", answer.matching, "Number of those that the request asks for, of any age");
  v.required("has_older", answer.has_older,
             "True: events older than these match, too; ask again with before");
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
void visit(Visitor& v, FramePart& part) {
  v.required("first", part.first, "Number of the first picture with this part, from 0");
  v.required("x", part.x, "Left edge in the camera's picture", "px");
  v.required("y", part.y, "Upper edge", "px");
  v.required("width", part.width, "Width", "px");
  v.required("height", part.height, "Height", "px");
}

template <class Visitor>
void visit(Visitor& v, RecordedFrames& frames) {
  v.required("camera", frames.camera, "Name of the camera");
  v.required("times", frames.times, "Times of the pictures' frame sets, UTC, ascending");
  v.required("parts", frames.parts, "Part of the camera's picture that is recorded");
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

template <class Visitor>
void visit(Visitor& v, RecordedSignal& signal) {
  v.required("region", signal.region, "Name of the region; empty: of the machine");
  v.required("figure", signal.figure, "Name of the signal");
  v.required("unit", signal.unit, "Its unit");
}

struct SignalsAnswer {
  std::vector<RecordedSignal> signals;
};
template <class Visitor>
void visit(Visitor& v, SignalsAnswer& answer) {
  v.required("signals", answer.signals, "Signals with a value in any frame set");
}

template <class Visitor>
void visit(Visitor& v, RecordedRegion& region) {
  v.required("name", region.name, "Name of the region");
  v.required("camera", region.camera, "Name of a camera that it is measured in");
  v.required("lines", region.lines,
             "Outline in the camera's whole picture: lines of pixels [u, v], whose centres are at "
             "integers");
}

template <class Visitor>
void visit(Visitor& v, RecordedRecipe& recipe) {
  v.required("number", recipe.number, "Number of the recipe");
  v.required("regions", recipe.regions, "Its regions by camera");
}

template <class Visitor>
void visit(Visitor& v, RecordedRecipeChange& change) {
  v.required("time", change.time, "UTC of the first frame set by the recipe");
  v.required("recipe", change.recipe, "Number of the recipe; 0: none");
}

struct RegionsAnswer {
  std::vector<RecordedRecipeChange> changes;
  std::vector<RecordedRecipe> recipes;
};
template <class Visitor>
void visit(Visitor& v, RegionsAnswer& answer) {
  v.required("changes", answer.changes, "Recipes that it was measured by, in their order");
  v.required("recipes", answer.recipes, "All recipes of the recorded configuration");
}

struct SignalQuery {
  std::string event, region, figure;
};
template <class Visitor>
void visit(Visitor& v, SignalQuery& query) {
  v.required("event", query.event, "Name of the event");
  v.optional("region", query.region, "Name of the region; without it, the machine's state");
  v.required("figure", query.figure, "Name of the signal");
}

template <class Visitor>
void visit(Visitor& v, RecordedCourse& course) {
  v.required("unit", course.unit, "Unit of the signal");
  v.required("times", course.times, "UTC of the first frame set of each step");
  v.required("frame_sets", course.frame_sets, "Its number");
  v.required("low", course.low, "Lowest value of each step; null: not valid");
  v.required("high", course.high, "Highest value of each step");
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
