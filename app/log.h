#pragma once

#include <string_view>

namespace orbwatch::app {

/// Syslog's levels, which journald reads from the start of a line.
enum class LogLevel { Error = 3, Warning = 4, Info = 6 };

/// One line on stderr, whole even when several threads write. When stderr is the journal, the level
/// goes in front as "<n>". Thread-safe; may wait for the terminal, so never per frame.
void log_line(LogLevel level, std::string_view text);

}  // namespace orbwatch::app
