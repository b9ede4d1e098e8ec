// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace orbwatch::app {

/// Syslog's levels, which the journal uses.
enum class LogLevel { Error = 3, Warning = 4, Info = 6 };

/// Subject of a line: fields of the journal, to select lines by. Empty or 0: no such subject.
struct LogFields {
  std::string_view camera{};  ///< name in the site's files
  std::string_view fault{};   ///< hal::word(), also for a fault that has ended
  std::uint64_t trigger = 0;  ///< number of the trigger
};

struct LogRecord {
  LogLevel level = LogLevel::Info;
  std::string_view text;
  LogFields fields;
};

/// Logs one line, never mixed with that of another thread: to the process's LogWriter, with a wait
/// of at most LogWriter::kLongestWait, or without one by write_text(). Thread-safe; allocates and
/// may wait, so never on the frame path or under a lock that others wait for.
void log_line(LogLevel level, std::string_view text, const LogFields& fields = {});

/// Calls log_line() for one camera, whose name begins the line and is its field.
void log_camera(LogLevel level, std::string_view camera, std::string_view text);

/// Logs the joined texts, for the frame path and for threads that serve many: with a LogWriter it
/// neither allocates nor waits for the reader. Surplus lines are dropped and counted, a long one is
/// cut.
void log_soon(LogLevel level, std::initializer_list<std::string_view> text,
              const LogFields& fields = {});

/// Writes one line to stderr. If stderr is the journal's, the prefix "<n>" is its level; on a
/// terminal it replaces an unfinished line.
void write_text(const LogRecord& record);

/// True if stderr is connected to the journal, by the rule of systemd.exec(5) for JOURNAL_STREAM.
/// Must not be called while the environment is changed.
bool is_journal_on_stderr();

}  // namespace orbwatch::app
