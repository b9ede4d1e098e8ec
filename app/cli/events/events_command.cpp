// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <filesystem>
#include <tuple>
#include <utility>

#include "app/cli/command.h"
#include "app/cli/events/events_text.h"
#include "app/cli/options/options.h"
#include "app/files/resolve.h"
#include "app/files/runtime/site_file.h"
#include "app/ports/recorder/events/event_folder.h"
#include "app/ports/recorder/recorder_settings.h"

namespace orbwatch::app::cli {
namespace {

using recorder::EventFolder;
using recorder::StoredEvent;

constexpr const char* kEventsUsage =
    "Usage: orbwatch events list [--json] [--config SITE | --folder DIR]\n"
    "       orbwatch events show NAME [--json] [...]\n"
    "       orbwatch events pin | unpin | rm NAME [...]\n"
    "\n"
    "Events that orbwatchd recorded with pictures: folders in `events` of its recordings, each\n"
    "with event.mcap for ROS 2, Foxglove and Python, trigger.jpg and summary.json. A pinned event\n"
    "is not deleted for room; `rm` deletes it nevertheless.\n"
    "\n";

constexpr const char* kEventsNotes =
    "\n"
    "--json of list prints one object: events [{name, folder, bytes, pinned, finished}], the "
    "oldest\n"
    "first; that of show adds summary, the object of summary.json: trigger, text, first, "
    "triggered\n"
    "and last frame set (UTC), frame_set (number of the trigger's), recipe, part, layer, pictures "
    "by\n"
    "camera, lost pictures, has_beginning, is_interrupted, versions.\n";

/// Folder of the recordings of a site.
Result<std::filesystem::path> recordings_of(const std::filesystem::path& config) {
  const auto site = files::read_site(files::site_file(config));
  if (!site) return tl::unexpected(site.error());
  const auto& settings = std::get<RecorderSettings>(site->sinks);
  if (settings.folder.empty()) {
    return fail("the configuration has no recordings; set [recorder] folder, or say --folder");
  }
  return settings.folder;
}

Result<std::string> list(const EventFolder& folder, bool json) {
  return folder.list().map([json](const std::vector<StoredEvent>& events) {
    return json ? stored_events_json(events) : stored_events_text(events);
  });
}

Result<std::string> show(const StoredEvent& event, bool json) {
  return recorder::read_summary(event.folder).map([&](const recorder::EventSummary& summary) {
    return json ? stored_event_json(event, summary) : stored_event_text(event, summary);
  });
}

Result<std::string> pin(const StoredEvent& event, bool is_pinned) {
  return EventFolder::set_pinned(event, is_pinned).map([&] {
    return event.name + (is_pinned ? " is pinned\n" : " is not pinned\n");
  });
}

Result<std::string> remove(const EventFolder& folder, const StoredEvent& event) {
  if (!event.is_finished) return fail(event.name + " is being recorded; delete it afterwards");
  return folder.remove(event).map([&] { return event.name + " is deleted\n"; });
}

Result<std::string> act_on(const EventFolder& folder, const std::string& what,
                           const std::string& name, bool json) {
  const auto event = folder.find(name);
  if (!event) return tl::unexpected(event.error());
  if (what == "show") return show(*event, json);
  if (what == "rm") return remove(folder, *event);
  return pin(*event, what == "pin");
}

CliResult<std::string> run_events(const std::vector<std::string>& words, bool json,
                                  std::filesystem::path recordings,
                                  const std::filesystem::path& config) {
  constexpr std::array kActions{"show", "pin", "unpin", "rm"};
  const std::string what = words.empty() ? "" : words.front();
  const bool is_list = what == "list" && words.size() == 1;
  const bool is_action = words.size() == 2 && std::ranges::find(kActions, what) != kActions.end();
  if (!is_list && !is_action) return usage_error("say list, or show, pin, unpin or rm NAME");
  if (json && !is_list && what != "show") return usage_error("--json is for list and show");
  if (!recordings.empty() && !config.empty()) return usage_error("say --config or --folder");
  if (recordings.empty()) {
    auto stated = recordings_of(config);
    if (!stated) return tl::unexpected(stated.error());
    recordings = std::move(*stated);
  }
  const EventFolder folder(recordings);
  return is_list ? list(folder, json) : act_on(folder, what, words[1], json);
}

}  // namespace

CliResult<std::string> events_command(const Arguments& arguments) {
  std::filesystem::path config, folder;
  bool json = false;
  return run_command(
      arguments,
      {.usage = kEventsUsage,
       .options = {{"config", 'c', "SITE", "the file that orbwatchd runs (default: as orbwatchd)",
                    text_option(config)},
                   {"folder", 0, "DIR", "folder of recordings, such as a copy of orbwatchd's",
                    text_option(folder)},
                   {"json", 0, "", "list or show for programs", flag_option(json)}},
       .takes_words = true,
       .notes = kEventsNotes},
      [&](const auto& words) { return run_events(words, json, folder, config); });
}

}  // namespace orbwatch::app::cli
