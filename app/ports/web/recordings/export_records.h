// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "app/model/sink/recorded_exports.h"
#include "proc/settings/settings.h"

/// Records of exports of the recorder's events.
namespace orbwatch::app::web {

struct ExportBody {
  ExportRequest request;
};
template <class Visitor>
void visit(Visitor& v, ExportBody& body) {
  ExportRequest& request = body.request;
  v.required("event", request.event, "Name of the event");
  v.required("format", request.format, kExportFormats,
             "Kind of file: a recording, a table of signals and machine state, a camera's pictures "
             "as TIFF or as video, or all of it");
  v.optional("camera", request.camera,
             "Camera of tif and avi; may be left out if the event has pictures of one alone");
  v.optional("from", request.from,
             "First frame set: its number, or UTC such as 2026-11-28T09:22:00.125Z; default: the "
             "event's first");
  v.optional("to", request.to, "Last frame set, likewise");
  v.optional("draws", request.draws, "Draw the values of each frame set into avi");
}

struct ExportNumber {
  std::uint64_t number = 0;
};
template <class Visitor>
void visit(Visitor& v, ExportNumber& sent) {
  v.required("number", sent.number, Range::between(1, 1e15), "Number of the export");
}

template <class Visitor>
void visit(Visitor& v, ExportStatus& status) {
  v.required("number", status.number, "Counts exports since the start; 0: there was none");
  v.required("state", status.state, kExportStates,
             "State of the newest one; none: cancelled, or its file was downloaded or removed");
  v.required("event", status.event, "Name of its event");
  v.required("user", status.user, "User who began it; empty: there are no users");
  v.required("file", status.file, "Name of its file");
  v.required("done", status.done, "Parts of its present step that are done");
  v.required("of", status.of, "Number of these parts; 0: not known yet");
  v.required("unit", status.unit, "These parts: chunks, frame sets, pictures, or bytes");
  v.required("bytes", status.bytes, "Size so far", "B");
  v.required("error", status.error, "Reason of a failure");
}

}  // namespace orbwatch::app::web
