// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/recordings/export_routes.h"

#include <string>

#include "app/ports/web/http/open_file.h"
#include "app/ports/web/recordings/recording_routes.h"

namespace orbwatch::app::web {
namespace {

constexpr const char* kNoExports = "no events are recorded: set [recorder.events]";

/// The finished file of an export.
Response finished_file(RecordedExports& exports, std::uint64_t number, bool is_sent) {
  const ExportStatus status = exports.status();
  const auto file = exports.file(number).and_then(open_file);
  if (!file) return error_response(404, file.error().message);
  Response response = file_response(kMcap, *file);
  // Names of files have letters, digits and "-_." only.
  response.headers.emplace_back("Content-Disposition",
                                "attachment; filename=\"" + status.file + "\"");
  if (is_sent) static_cast<void>(exports.remove(number));  // fails if another request was quicker
  return response;
}

}  // namespace

void ExportRoutes::start() const {
  if (exports_) exports_->start();
}

void ExportRoutes::stop() const {
  if (exports_) exports_->stop();
}

std::chrono::nanoseconds ExportRoutes::cpu_time() const {
  return exports_ ? exports_->cpu_time() : std::chrono::nanoseconds(0);
}

Answered<ExportStatus> ExportRoutes::status() const {
  return exports_ ? exports_->status() : ExportStatus{};
}

void ExportRoutes::file(const ExportNumber& query, const ExchangePtr& exchange) const {
  const bool is_sent = exchange->request().method == "GET";
  changes_.read(exchange, [exports = exports_, number = query.number, is_sent] {
    return exports ? finished_file(*exports, number, is_sent) : error_response(404, kNoExports);
  });
}

Answered<ExportNumber> ExportRoutes::begin(Change<ExportBody>& change) const {
  ExportRequest& request = change.body.request;
  change.after =
      event_for_audit(request.event) + " " + std::string(word_for(kExportFormats, request.format));
  if (!exports_) return refuse(404, kNoExports);
  request.user = change.caller.name;
  const auto begun = exports_->begin(request);
  if (!begun) return refuse(begun.error());
  return ExportNumber{*begun};
}

Answered<Done> ExportRoutes::cancel(Change<ExportNumber>& change) const {
  if (!exports_) return refuse(404, kNoExports);
  const ExportStatus status = exports_->status();
  change.before = status.event;
  if (status.user != change.caller.name && change.caller.role < Role::Operator) {
    return refuse(
        403, "the export is that of " + status.user + "; the role operator is needed to cancel it");
  }
  const auto cancelled = exports_->remove(change.body.number);
  if (!cancelled) return refuse(cancelled.error());
  return Done{};
}

}  // namespace orbwatch::app::web
