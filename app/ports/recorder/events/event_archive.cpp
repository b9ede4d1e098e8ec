// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_archive.h"

#include <algorithm>
#include <string>
#include <utility>

#include "app/ports/recorder/events/event_summary.h"

namespace orbwatch::app::recorder {
namespace {

tl::unexpected<Error> being_recorded(const StoredEvent& stored) {
  return fail("the event " + stored.name + " is being recorded");
}

/// Without a summary, which another program may have damaged, only what the folder says.
RecordedEvent recorded(const StoredEvent& stored) {
  RecordedEvent event;
  event.name = stored.name;
  event.bytes = stored.bytes;
  event.is_pinned = stored.is_pinned;
  event.is_finished = stored.is_finished;
  auto summary = read_summary(stored.folder);
  if (!summary) {
    event.text = summary.error().message;
    return event;
  }
  event.trigger = std::move(summary->trigger);
  event.text = std::move(summary->text);
  event.alarm = std::move(summary->alarm);
  event.line = std::move(summary->line);
  event.first = std::move(summary->first);
  event.triggered = std::move(summary->triggered);
  event.last = std::move(summary->last);
  event.part = std::move(summary->part);
  event.layer = summary->layer;
  for (const auto& [camera, pictures] : summary->pictures) event.pictures += pictures;
  event.lost = summary->lost;
  event.has_beginning = summary->has_beginning;
  event.is_interrupted = summary->is_interrupted;
  return event;
}

}  // namespace

Result<std::shared_ptr<const std::vector<RecordedEvent>>> EventArchive::list() {
  const std::lock_guard lock(mutex_);
  const auto updated = index_.update();
  if (!updated) return tl::unexpected(updated.error());
  if (!*updated) return listed_;
  auto events = std::make_shared<std::vector<RecordedEvent>>();
  events->reserve(index_.events().size());
  for (const StoredEvent& one : index_.events()) {
    const auto known = std::ranges::lower_bound(stored_, one.name, {}, &StoredEvent::name);
    const bool is_same = one.changed && known != stored_.end() && *known == one;
    events->push_back(is_same ? (*listed_)[static_cast<std::size_t>(known - stored_.begin())]
                              : recorded(one));
  }
  stored_ = index_.events();
  listed_ = std::move(events);
  return listed_;
}

Result<StoredEvent> EventArchive::finished(std::string_view event) const {
  return folder_.find(event).and_then([](StoredEvent stored) -> Result<StoredEvent> {
    if (stored.is_finished) return stored;
    if (EventFolder::is_being_recorded(stored)) return being_recorded(stored);
    return fail("the event " + stored.name +
                " was not recorded to its end; the next start of orbwatchd finishes it, or its log "
                "states why not");
  });
}

Result<std::filesystem::path> EventArchive::recording(std::string_view event) const {
  return finished(event).map([](const StoredEvent& stored) { return stored.folder / kEventFile; });
}

Result<std::filesystem::path> EventArchive::picture(std::string_view event) const {
  return finished(event).map(
      [](const StoredEvent& stored) { return stored.folder / kEventPicture; });
}

Result<std::vector<RecordedFrames>> EventArchive::frames(std::string_view event) {
  return recording(event).and_then([this](const auto& file) { return pictures_.frames(file); });
}

Result<std::string> EventArchive::frame(std::string_view event, std::string_view camera,
                                        std::size_t frame) {
  return recording(event).and_then(
      [&](const auto& file) { return pictures_.jpeg(file, camera, frame); });
}

Result<std::vector<RecordedSignal>> EventArchive::signals(std::string_view event) {
  return recording(event).and_then([this](const auto& file) { return signals_.list(file); });
}

Result<std::vector<RecordedRecipeChange>> EventArchive::recipes(std::string_view event) {
  return recording(event).and_then([this](const auto& file) { return signals_.recipes(file); });
}

Result<RecordedCourse> EventArchive::course(std::string_view event, const std::string& region,
                                            const std::string& figure) {
  return recording(event).and_then(
      [&](const auto& file) { return signals_.course(file, region, figure); });
}

Result<> EventArchive::set_pinned(std::string_view event, bool is_pinned) {
  return finished(event).and_then([is_pinned](const StoredEvent& stored) {
    return EventFolder::set_pinned(stored, is_pinned);
  });
}

Result<> EventArchive::remove(std::string_view event) {
  return folder_.find(event).and_then([this](const StoredEvent& stored) -> Result<> {
    if (EventFolder::is_being_recorded(stored)) return being_recorded(stored);
    return folder_.remove(stored);
  });
}

}  // namespace orbwatch::app::recorder
