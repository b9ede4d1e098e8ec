#include "app/ports/web/access/audit.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "app/log.h"
#include "app/model/utc_text.h"
#include "app/state/private_file.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::web {
namespace {

using Json = nlohmann::ordered_json;

std::string line_of(const Audit::Entry& entry) {
  const Json line{{"time", utc_text(entry.time).value_or("")},
                  {"who", entry.who},
                  {"from", entry.from},
                  {"what", entry.what},
                  {"before", entry.before},
                  {"after", entry.after},
                  {"result", entry.result}};
  // A name that somebody tried may be no text.
  return line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Begins a new line when a power cut has left a part of one. False with errno.
bool append(const std::filesystem::path& file, std::string line) {
  const hal::FileDescriptor opened(::open(
      file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC, S_IRUSR | S_IWUSR));
  struct stat about {};
  if (!opened.is_open() || ::fstat(opened.get(), &about) != 0) return false;
  char last = '\n';
  if (about.st_size > 0 && ::pread(opened.get(), &last, 1, about.st_size - 1) != 1) return false;
  if (last != '\n') line.insert(0, 1, '\n');
  return ::write(opened.get(), line.data(), line.size()) == static_cast<ssize_t>(line.size()) &&
         ::fdatasync(opened.get()) == 0;
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

void Audit::note(const Entry& entry) {
  if (folder_.empty()) return;
  const std::string line = line_of(entry);
  const std::lock_guard lock(mutex_);
  std::error_code absent;
  const auto size = std::filesystem::file_size(file(), absent);
  const bool is_full = !absent && size + line.size() > kMostBytes;
  if (is_full && ::rename(file().c_str(), file_before().c_str()) != 0) {
    log_line(LogLevel::Error,
             file().string() + ": cannot be renamed: " + std::system_category().message(errno));
    return;
  }
  if (append(file(), line)) return;
  log_line(LogLevel::Error, file().string() +
                                ": cannot be written: " + std::system_category().message(errno) +
                                "; lost: " + line.substr(0, line.size() - 1));
}

std::string Audit::newest(std::size_t most) const {
  std::vector<Json> entries;
  if (!folder_.empty()) {
    const std::lock_guard lock(mutex_);
    add_lines(file_before(), entries);
    add_lines(file(), entries);
  }
  if (entries.size() > most) {
    entries.erase(entries.begin(), entries.end() - static_cast<std::ptrdiff_t>(most));
  }
  return Json{{"entries", entries}}.dump();
}

}  // namespace orbwatch::app::web
