// SPDX-License-Identifier: Apache-2.0
#include "app/service/journal.h"

// The source location would always be this file.
#define SD_JOURNAL_SUPPRESS_LOCATION
#include <systemd/sd-journal.h>
#include <unistd.h>

#include <cerrno>

#include <string>
#include <string_view>
#include <vector>

namespace orbwatch::app {
namespace {

constexpr const char* kSocket = "/run/systemd/journal/socket";

void add(std::vector<std::string>& fields, const char* name, std::string_view value) {
  if (!value.empty()) fields.push_back(std::string(name).append("=").append(value));
}

void write_journal(const LogRecord& record) {
  std::vector<std::string> fields;
  add(fields, "MESSAGE", record.text);
  // Same identifier that systemd gives to lines on stderr; the process's name differs after it
  // re-executed itself.
  add(fields, "SYSLOG_IDENTIFIER", program_invocation_short_name);
  add(fields, "PRIORITY", std::to_string(static_cast<int>(record.level)));
  add(fields, kCameraField, record.fields.camera);
  add(fields, kFaultField, record.fields.fault);
  if (record.fields.trigger > 0) {
    add(fields, kTriggerField, std::to_string(record.fields.trigger));
  }
  std::vector<iovec> parts;
  parts.reserve(fields.size());
  for (std::string& field : fields) parts.push_back({field.data(), field.size()});
  if (::sd_journal_sendv(parts.data(), static_cast<int>(parts.size())) < 0) write_text(record);
}

}  // namespace

LogWriter::Output log_output() {
  // libsystemd drops messages without an error if the journal is not running.
  const bool is_there = is_journal_on_stderr() && ::access(kSocket, F_OK) == 0;
  return is_there ? write_journal : write_text;
}

}  // namespace orbwatch::app
