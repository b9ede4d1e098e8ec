// SPDX-License-Identifier: Apache-2.0
#include "app/state/state_folder.h"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "hal/atomic_file.h"
#include "hal/regular_file.h"

namespace orbwatch::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kService = "orbwatch";

/// First folder of a list in the environment.
std::optional<fs::path> first_folder(const char* variable) {
  const char* const folders = std::getenv(variable);
  const std::string_view all = folders != nullptr ? folders : "";
  const std::string_view first = all.substr(0, all.find(':'));
  if (first.empty()) return std::nullopt;
  return fs::path(first);
}

fs::path owner_record(const fs::path& folder) { return folder / "configuration"; }

fs::path in_full(const fs::path& file) {
  std::error_code none;
  const fs::path absolute = fs::absolute(file, none);
  return (none ? file : absolute).lexically_normal();
}

/// Compares by file, so that a symbolic link matches.
bool is_same(const fs::path& a, const fs::path& b) {
  std::error_code none;
  return a == b || fs::equivalent(a, b, none);
}

bool is_owned_by(const fs::path& folder, const fs::path& configuration) {
  const auto owner = owner_of(folder);
  return owner && is_same(*owner, configuration);
}

/// The service's name for this configuration file: a second machine's has its own behind `mark`.
std::string name_for(const fs::path& configuration, const char* mark) {
  const fs::path folder = configuration.parent_path();
  const bool is_instance =
      configuration.filename() == "site.toml" && folder.parent_path() == "/etc/orbwatch";
  return std::string(kService) + (is_instance ? mark + folder.filename().string() : "");
}

/// State folders of all machines on this board, sorted.
std::vector<fs::path> service_folders(const fs::path& lib) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (fs::directory_iterator it(lib, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (name == kService || name.starts_with(std::string(kService) + "-")) {
      folders.push_back(it->path());
    }
  }
  std::ranges::sort(folders);
  return folders;
}

std::vector<fs::path> folders_of(const fs::path& configuration, const fs::path& lib) {
  auto folders = service_folders(lib);
  std::erase_if(folders, [&](const fs::path& f) { return !is_owned_by(f, configuration); });
  return folders;
}

/// True if this user may not look into a state folder, so that its owner is unknown.
bool is_denied(const fs::path& folder) {
  std::error_code error;
  return !fs::exists(owner_record(folder), error) && error == std::errc::permission_denied;
}

/// Error: the folder records another configuration file, or this user may not look into it.
/// `owned`: folders that record this one.
Result<fs::path> check_owner(const fs::path& folder, const fs::path& configuration,
                             const std::vector<fs::path>& owned) {
  if (is_denied(folder)) {
    return fail(folder.string() +
                ": only root and its service may look into it; run the command with sudo");
  }
  const auto owner = owner_of(folder);
  if (!owner || is_same(*owner, configuration)) return folder;
  const std::string own = owned.empty() ? "FOLDER" : owned.front().string();
  return fail(folder.string() + ": is the state folder of " + owner->string() + ", not of " +
              configuration.string() + "; pass --config " + owner->string() +
              ", or before the command STATE_DIRECTORY=" + own +
              (owned.empty() ? ", the folder of the other one" : ""));
}

}  // namespace

std::optional<fs::path> state_directory() { return first_folder("STATE_DIRECTORY"); }

std::optional<fs::path> runtime_directory() { return first_folder("RUNTIME_DIRECTORY"); }

std::string unit_of(const fs::path& configuration) { return name_for(in_full(configuration), "@"); }

Result<fs::path> state_folder(const fs::path& configured, const fs::path& configuration,
                              const fs::path& lib) {
  if (!configured.empty()) return configured;
  const fs::path own = in_full(configuration);
  const std::vector<fs::path> owned = folders_of(own, lib);
  if (const auto given = state_directory()) return check_owner(*given, own, owned);
  const fs::path usual = lib / name_for(own, "-");
  if (owned.empty() || std::ranges::count(owned, usual) > 0) return check_owner(usual, own, owned);
  if (owned.size() == 1) return owned.front();
  std::string text = own.string() + ": several state folders exist; set before the command";
  for (const fs::path& folder : owned) {
    text +=
        (folder == owned.front() ? " STATE_DIRECTORY=" : " or STATE_DIRECTORY=") + folder.string();
  }
  return fail(text);
}

Result<hal::FileDescriptor> reserve(const fs::path& folder) {
  std::error_code none;  // a missing folder fails in open()
  fs::create_directories(folder, none);
  constexpr mode_t kMode = 0644;  // sufficient for a lock, and root may have created it
  hal::FileDescriptor file(
      ::open((folder / "reserved").c_str(), O_RDONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, kMode));
  const bool is_taken =
      file.is_open() && ::flock(file.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (!is_taken) return file;
  return fail(folder.string() +
              ": another orbwatchd runs with this STATE_DIRECTORY; set a different one for each");
}

std::optional<fs::path> owner_of(const fs::path& folder) {
  auto text = hal::read_regular_file(owner_record(folder));
  if (!text) return std::nullopt;
  if (text->ends_with('\n')) text->pop_back();
  if (text->empty()) return std::nullopt;
  return fs::path(*text);
}

Result<std::optional<fs::path>> record_owner(const fs::path& folder,
                                             const fs::path& configuration) {
  const fs::path own = in_full(configuration);
  const auto before = owner_of(folder);
  if (before == own) return std::nullopt;
  std::error_code none;  // write_file() reports a fault of the folder
  fs::create_directories(folder, none);
  return hal::write_file(owner_record(folder), own.string() + "\n").map([&] {
    return before && !is_same(*before, own) ? before : std::nullopt;
  });
}

}  // namespace orbwatch::app
