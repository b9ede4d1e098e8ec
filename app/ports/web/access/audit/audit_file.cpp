// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/audit/audit_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <sstream>
#include <system_error>

#include "app/log.h"
#include "app/ports/web/api/record.h"
#include "app/state/private_file.h"
#include "hal/regular_file.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::web {
namespace {

/// Appends lines, after a line break if a power cut has left a partial line. False: failed, errno
/// is set.
bool append_to(const std::filesystem::path& file, std::string lines) {
  const hal::FileDescriptor opened(::open(
      file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC, S_IRUSR | S_IWUSR));
  struct stat about {};
  if (!opened.is_open() || ::fstat(opened.get(), &about) != 0) return false;
  char last = '\n';
  if (about.st_size > 0 && ::pread(opened.get(), &last, 1, about.st_size - 1) != 1) return false;
  if (last != '\n') lines.insert(0, 1, '\n');
  return hal::write_all(opened, lines) && ::fdatasync(opened.get()) == 0;
}

void add_lines(const std::filesystem::path& file, std::vector<Json>& entries) {
  const auto text = read_private(file);
  if (!text || !*text) return;
  std::istringstream lines(**text);
  for (std::string line; std::getline(lines, line);) {
    Json entry = Json::parse(line, nullptr, false);
    if (entry.is_object()) entries.push_back(std::move(entry));
  }
}

}  // namespace

/// Appends several entries at once, because each write waits for the disk.
void AuditFile::append(const std::vector<AuditEntry>& entries) {
  constexpr std::size_t kMostAtOnce = 64 * 1024;
  if (folder_.empty() || entries.empty()) return;
  std::string lines;
  for (AuditEntry entry : entries) {
    const std::string line = json_text(json_of(entry)) + "\n";
    if (!lines.empty() && lines.size() + line.size() > kMostAtOnce) {
      append_lines(std::exchange(lines, {}));
    }
    lines += line;
  }
  append_lines(lines);
}

void AuditFile::append_lines(const std::string& lines) {
  const std::lock_guard lock(mutex_);
  std::error_code absent;
  const auto size = std::filesystem::file_size(file(), absent);
  const bool is_full = !absent && size + lines.size() > kMostBytes;
  if (is_full && ::rename(file().c_str(), file_before().c_str()) != 0) {
    log_line(LogLevel::Error,
             file().string() + ": cannot be renamed: " + std::system_category().message(errno));
    return;
  }
  if (append_to(file(), lines)) return;
  log_line(LogLevel::Error, file().string() +
                                ": cannot be written: " + std::system_category().message(errno) +
                                "; lost: " + lines.substr(0, lines.size() - 1));
}

std::vector<Json> AuditFile::newest(std::size_t most) const {
  std::vector<Json> entries;
  if (folder_.empty()) return entries;
  const std::lock_guard lock(mutex_);
  add_lines(file_before(), entries);
  add_lines(file(), entries);
  if (entries.size() > most) {
    entries.erase(entries.begin(), entries.end() - static_cast<std::ptrdiff_t>(most));
  }
  return entries;
}

}  // namespace orbwatch::app::web
