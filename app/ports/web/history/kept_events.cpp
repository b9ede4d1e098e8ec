// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/history/kept_events.h"

#include <utility>

#include "app/log.h"
#include "app/ports/web/api/record_schema.h"
#include "app/ports/web/history/history_records.h"
#include "app/state/private_file.h"

namespace orbwatch::app::web {
namespace {

/// Error: the file cannot be read, or has something else.
Result<std::vector<Json>> events_in(const std::filesystem::path& file) {
  const auto text = read_private(file);
  if (!text) return tl::unexpected(text.error());
  if (!*text) return std::vector<Json>();
  const Json json = Json::parse(**text, nullptr, false);
  if (json.is_discarded()) return fail(file.string() + ": is not JSON");
  return check_form(json, schema_of<AlarmsAnswer, Sent::ByUs>(), file.string()).map([&] {
    return json.at("alarms").get<std::vector<Json>>();
  });
}

}  // namespace

KeptEvents::KeptEvents(std::filesystem::path file) : file_(std::move(file)) {
  if (file_.empty()) return;
  auto events = events_in(file_);
  if (!events) {
    log_line(LogLevel::Warning, "no events of alarms before this start: " + events.error().message);
    return;
  }
  before_ = std::move(*events);
  if (!before_.empty()) newest_number_ = before_.back().at("number").get<std::uint64_t>();
}

void KeptEvents::write(const std::vector<Json>& events) const {
  if (file_.empty()) return;
  if (const auto written = write_private(file_, json_text({{"alarms", events}}) + "\n"); !written) {
    log_line(LogLevel::Warning, "events of alarms are not kept: " + written.error().message);
  }
}

}  // namespace orbwatch::app::web
