// SPDX-License-Identifier: Apache-2.0
#include "app/log.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "app/log_writer.h"

namespace orbwatch::app {

void log_line(LogLevel level, std::string_view text, const LogFields& fields) {
  const LogRecord record{level, text, fields};
  if (LogWriter* const writer = LogWriter::current()) {
    writer->write(record);
  } else {
    write_text(record);
  }
}

void log_camera(LogLevel level, std::string_view camera, std::string_view text) {
  log_line(level, std::string(camera).append(": ").append(text), {.camera = camera});
}

void log_soon(LogLevel level, std::initializer_list<std::string_view> text,
              const LogFields& fields) {
  if (LogWriter* const writer = LogWriter::current()) {
    writer->write_soon(level, text, fields);
    return;
  }
  std::string joined;
  for (const std::string_view part : text) joined += part;
  write_text({level, joined, fields});
}

bool is_journal_on_stderr() {
  const char* const stream = std::getenv("JOURNAL_STREAM");
  struct stat file {};
  if (stream == nullptr || ::fstat(STDERR_FILENO, &file) != 0) return false;
  return std::to_string(file.st_dev) + ":" + std::to_string(file.st_ino) == stream;
}

void write_text(const LogRecord& record) {
  std::string line;
  if (is_journal_on_stderr()) {
    line = "<" + std::to_string(static_cast<int>(record.level)) + ">";
  } else if (::isatty(STDERR_FILENO) != 0) {
    line = "\r\x1b[K";  // overwrites the progress of a command on an unfinished line
  }
  line += "orbwatch: ";
  line += record.text;
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace orbwatch::app
