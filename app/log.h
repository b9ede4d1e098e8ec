#pragma once

#include <string_view>

namespace orbwatch::app {

/// Syslog's levels; journald reads them from the start of a line.
enum class LogLevel { Error = 3, Warning = 4, Info = 6 };

/// Writes one line to stderr, never mixed with that of another thread. In the journal "<n>" in
/// front is its level. Thread-safe; may wait for the terminal, so never per frame.
void log_line(LogLevel level, std::string_view text);

}  // namespace orbwatch::app
