#include "app/log.h"

#include <cstdio>
#include <cstdlib>
#include <string>

namespace orbwatch::app {

void log_line(LogLevel level, std::string_view text) {
  static const bool journal = std::getenv("JOURNAL_STREAM") != nullptr;
  std::string line;
  if (journal) line = "<" + std::to_string(static_cast<int>(level)) + ">";
  line += "orbwatch: ";
  line += text;
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace orbwatch::app
