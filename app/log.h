#pragma once

#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace orbwatch::app {

/// Syslog's levels, which are the journal's.
enum class LogLevel { Error = 3, Warning = 4, Info = 6 };

/// What a line is about: fields of the journal, to select lines by. Empty or 0: not about one.
struct LogFields {
  std::string_view camera{};  ///< its name in the site's files
  std::string_view fault{};   ///< hal::word(), also of the fault that is over
  std::uint64_t trigger = 0;  ///< number of the trigger
};

struct LogRecord {
  LogLevel level = LogLevel::Info;
  std::string_view text;
  LogFields fields;
};

/// Logs one line, never mixed with that of another thread: to the process's LogWriter, which is
/// waited for at most LogWriter::kLongestWait, or without one by write_text(). Thread-safe;
/// allocates and may wait, so never on the frame path or under a lock that others wait for.
void log_line(LogLevel level, std::string_view text, const LogFields& fields = {});

/// log_line() about one camera, whose name begins the line and is its field.
void log_camera(LogLevel level, std::string_view camera, std::string_view text);

/// log_line() with the text joined, for the frame path and for threads that serve many: with a
/// LogWriter it neither allocates nor waits for the reader. Lines too many at once are dropped and
/// counted, a long one is cut.
void log_soon(LogLevel level, std::initializer_list<std::string_view> text,
              const LogFields& fields = {});

/// Writes one line to stderr. Where that is the journal's, "<n>" in front is its level; on a
/// terminal it takes the place of a line that has no end yet.
void write_text(const LogRecord& record);

/// Whether stderr is connected to the journal, by the rule of systemd.exec(5) for JOURNAL_STREAM.
/// Not while the environment is changed.
bool is_journal_on_stderr();

}  // namespace orbwatch::app
