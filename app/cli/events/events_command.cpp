// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <tuple>
#include <utility>

#include "app/cli/command.h"
#include "app/cli/events/event_export.h"
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
    "       orbwatch events export NAME -o FILE [--camera NAME] [--from SET] [--to SET]\n"
    "                              [--draw] [--force] [...]\n"
    "\n"
    "Events that orbwatchd recorded with pictures: folders in `events` of its recordings, each\n"
    "with event.mcap for ROS 2, Foxglove and Python, trigger.jpg and summary.json. A pinned event\n"
    "is not deleted for room; `rm` deletes it nevertheless. `export` writes one, or a range of "
    "it,\n"
    "as a file for other programs.\n"
    "\n";

constexpr const char* kEventsNotes =
    "\n"
    "The ending of FILE says what export writes:\n"
    "  .mcap  the range as a recording, byte for byte, with the configuration; for\n"
    "         orbwatch replay and the programs above\n"
    "  .csv   a row for each frame set: utc, utc_ns, frame_set, trigger, recipe, the signals as\n"
    "         region.NAME.SIGNAL, the machine's state as machine.VALUE\n"
    "  .tif   the pictures of a camera, grey or RGB, as pages with unchanged samples; the\n"
    "         description of each has utc of the exposure, camera, frame_set, x and y of the\n"
    "         recorded part in the camera's picture of width and height, celsius_per_count,\n"
    "         celsius_at_zero\n"
    "  .avi   the pictures of a camera as video (MJPEG) at the rate of their median interval;\n"
    "         16 bit is stretched from the darkest to the brightest pixel of all. --draw adds\n"
    "         UTC, frame set, signals and the machine's state below each picture\n"
    "  .zip   the event's folder with event.mcap and states.csv of the range\n"
    "SET is the number of a frame set, or UTC such as 2026-11-28T09:22:00.125Z; both ends\n"
    "belong to the range. Without them it is the whole event. An export that fails or is\n"
    "cancelled by Ctrl-C leaves no file.\n"
    "\n"
    "--json of list prints one object: events [{name, folder, bytes, pinned, finished}], the "
    "oldest\n"
    "first; that of show adds summary, the object of summary.json: trigger, text, alarm (region,\n"
    "signal, level, value, unit), line, first, triggered and last frame set (UTC), frame_set\n"
    "(number of the trigger's), recipe, part, layer, pictures by camera, lost pictures,\n"
    "has_beginning, is_interrupted, versions.\n";

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
  if (EventFolder::is_being_recorded(event)) {
    return fail(event.name + " is being recorded; delete it afterwards");
  }
  return folder.remove(event).map([&] { return event.name + " is deleted\n"; });
}

struct EventsOptions {
  std::filesystem::path config, folder;
  bool json = false;
  EventExport exported;
};

CliResult<std::string> act_on(const EventFolder& folder, const std::string& what,
                              const std::string& name, const EventsOptions& o) {
  const auto event = folder.find(name);
  if (!event) return tl::unexpected(event.error());
  if (what == "show") return show(*event, o.json);
  if (what == "export") return export_event(*event, o.exported);
  if (what == "rm") return remove(folder, *event);
  return pin(*event, what == "pin");
}

/// Checks that options and action go together.
CliResult<> check_options(const EventsOptions& o, const std::string& what) {
  const bool is_export = what == "export";
  const EventExport& exported = o.exported;
  if (o.json && what != "list" && what != "show") return usage_error("--json is for list and show");
  if (!o.folder.empty() && !o.config.empty()) return usage_error("say --config or --folder");
  if (is_export && exported.output.empty()) return usage_error("-o FILE is missing");
  const bool has_more = !exported.output.empty() || !exported.camera.empty() ||
                        exported.range.from || exported.range.to || exported.draws ||
                        exported.replaces;
  if (!is_export && has_more)
    return usage_error("-o, --camera, --from, --to, --draw and --force are for export");
  return {};
}

CliResult<std::string> run_events(const std::vector<std::string>& words, const EventsOptions& o) {
  constexpr std::array kActions{"show", "pin", "unpin", "rm", "export"};
  const std::string what = words.empty() ? "" : words.front();
  const bool is_list = what == "list" && words.size() == 1;
  const bool is_action = words.size() == 2 && std::ranges::find(kActions, what) != kActions.end();
  if (!is_list && !is_action)
    return usage_error("say list, or show, pin, unpin, rm or export NAME");
  if (auto checked = check_options(o, what); !checked) return tl::unexpected(checked.error());
  auto recordings = o.folder.empty() ? recordings_of(o.config) : o.folder;
  if (!recordings) return tl::unexpected(recordings.error());
  const EventFolder folder(*recordings);
  if (is_list) return list(folder, o.json);
  return act_on(folder, what, words[1], o);
}

std::function<Result<>(const std::string&)> range_option(const char* name,
                                                         std::optional<recorder::RangeEnd>& end) {
  return [name, &end](const std::string& value) {
    return recorder::parse_range_end(value)
        .map([&end](const recorder::RangeEnd& parsed) { end = parsed; })
        .map_error([name](const Error& error) {
          return Error{std::string("--") + name + ": " + error.message};
        });
  };
}

std::vector<Option> declare(EventsOptions& o) {
  EventExport& exported = o.exported;
  return {
      {"config", 'c', "SITE", "the file that orbwatchd runs (default: as orbwatchd)",
       text_option(o.config)},
      {"folder", 0, "DIR", "folder of recordings, such as a copy of orbwatchd's",
       text_option(o.folder)},
      {"json", 0, "", "list or show for programs", flag_option(o.json)},
      {"output", 'o', "FILE", "file to export to", text_option(exported.output)},
      {"camera", 0, "NAME", "camera whose pictures are exported; needed if there are several",
       text_option(exported.camera)},
      {"from", 0, "SET", "first frame set that is exported",
       range_option("from", exported.range.from)},
      {"to", 0, "SET", "last frame set that is exported", range_option("to", exported.range.to)},
      {"draw", 0, "", "draw the values of each frame set below the pictures of a video",
       flag_option(exported.draws)},
      {"force", 0, "", "replace FILE if it exists", flag_option(exported.replaces)}};
}

}  // namespace

CliResult<std::string> events_command(const Arguments& arguments) {
  EventsOptions o;
  return run_command(
      arguments,
      {.usage = kEventsUsage, .options = declare(o), .takes_words = true, .notes = kEventsNotes},
      [&](const auto& words) { return run_events(words, o); });
}

}  // namespace orbwatch::app::cli
