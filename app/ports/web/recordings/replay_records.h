// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/model/sink/recorded_replays.h"
#include "proc/settings/settings.h"

/// Records of replays of the recorder's events.
namespace orbwatch::app::web {

struct ReplayBody {
  std::string event;
  std::optional<std::uint16_t> recipe;
};
template <class Visitor>
void visit(Visitor& v, ReplayBody& body) {
  v.required("event", body.event, "Name of the event");
  v.optional("recipe", body.recipe,
             "Number of the appliance's recipe that measures the event; 0: those in the recording; "
             "default: the selected one");
}

struct ReplayNumber {
  std::uint64_t number = 0;
};
template <class Visitor>
void visit(Visitor& v, ReplayNumber& sent) {
  v.required("number", sent.number, Range::between(1, 1e15), "Number of the replay");
}

template <class Visitor>
void visit(Visitor& v, ReplayStatus& status) {
  v.required("number", status.number, "Counts replays since the start; 0: there was none");
  v.required("state", status.state, kReplayStates,
             "State of the newest one; none: cancelled, or its result was dropped");
  v.required("event", status.event, "Name of its event");
  v.required("recipe", status.recipe, "Number of its recipe; 0: those in the recording");
  v.required("user", status.user, "User who began it; empty: there are no users");
  v.required("done", status.done, "Frame sets that are measured");
  v.required("of", status.of, "Number of frame sets; 0: not known");
  v.required("error", status.error, "Reason of a failure");
}

template <class Visitor>
void visit(Visitor& v, RaisedAlarm& raised) {
  v.required("level", raised.level, "Level of the alarm");
  v.required("from", raised.from, "UTC of the first frame set at this level");
  v.required("to", raised.to, "UTC of the last one in succession");
  v.required("first", raised.first, "Number of the first frame set");
  v.required("last", raised.last, "Number of the last one");
}

template <class Visitor>
void visit(Visitor& v, ReplayedAlarm& alarm) {
  v.required("name", alarm.name, "Number, region and signal of the alarm");
  v.required("was_watched", alarm.was_watched, "The recorded recipe has it");
  v.required("is_watched", alarm.is_watched, "The recipe of the replay has it");
  v.required(
      "differs", alarm.differs,
      "It is raised at other frame sets; one earlier or later does not count, because delays "
      "count from the moment at which a set was measured");
  v.required("recorded", alarm.then, "When it was raised, in the order of the recording");
  v.required("computed", alarm.now, "When the recipe of the replay raises it");
  v.required("more", alarm.more, "Further times, which are left out: 50 of each are listed");
}

template <class Visitor>
void visit(Visitor& v, ReplayedSignal& signal) {
  v.required("region", signal.region, "Name of the region");
  v.required("figure", signal.figure, "Name of the signal");
  v.required("unit", signal.unit, "Its unit");
  v.required("sets", signal.sets, "Number of frame sets in which it differs");
  v.required("of_jpeg", signal.of_jpeg,
             "Those among them in which the recorder's JPEG explains the difference");
  v.required("largest", signal.largest,
             "Largest difference, in the unit; null: one of both values is missing in all of them");
  v.required("recorded", signal.recorded, "Recorded value there; null: not measured");
  v.required("computed", signal.computed, "Computed value there; null: not measured");
  v.required("largest_at", signal.largest_at, "UTC of that frame set");
  v.required("largest_set", signal.largest_set, "Its number");
  v.required("first_at", signal.first_at, "UTC of the first frame set that differs");
  v.required("first_set", signal.first_set, "Its number");
}

template <class Visitor>
void visit(Visitor& v, ReplayResult& result) {
  v.required("number", result.number, "Number of the replay");
  v.required("event", result.event, "Name of the event");
  v.required("recipe", result.recipe, "Number of the recipe; 0: those in the recording");
  v.required("sets", result.sets, "Frame sets that were measured");
  v.required("compared", result.compared, "Those among them that are compared");
  v.required("without_pictures", result.without_pictures,
             "Further frame sets, which were recorded without pictures");
  v.required("compared_from", result.compared_from,
             "UTC of the first one that is compared: rates and delays need the 2 s before it");
  v.required("is_settled", result.is_settled,
             "False: the event is shorter than that, and compared from its beginning");
  v.required("alarms", result.alarms, "All alarms of both recipes");
  v.required("signals", result.signals, "Signals of regions that differ");
}

struct ReplaySignalQuery : ReplayNumber {
  std::string region, figure;
};
template <class Visitor>
void visit(Visitor& v, ReplaySignalQuery& query) {
  visit(v, static_cast<ReplayNumber&>(query));
  v.required("region", query.region, "Name of the region");
  v.required("figure", query.figure, "Name of the signal");
}

}  // namespace orbwatch::app::web
