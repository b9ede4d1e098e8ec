// SPDX-License-Identifier: Apache-2.0
#include "app/cli/support/site_parts.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <functional>
#include <set>
#include <system_error>
#include <utility>

#include "app/cli/doctor/gather.h"
#include "app/cli/support/comments.h"
#include "app/files/lexical_path.h"
#include "app/state/state_folder.h"
#include "hal/regular_file.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::cli::support {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kConfigurationEndings{".toml", ".yaml", ".yml", ".xml"};
constexpr std::size_t kMostListed = 1000;

bool is_configuration(const fs::path& file) {
  return std::ranges::count(kConfigurationEndings, file.extension().string()) > 0;
}

/// Everything below a folder except folders, sorted. `error`: why not all of it.
std::vector<fs::path> files_below(const fs::path& folder, std::error_code& error) {
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    if (!it->is_directory(error)) files.push_back(it->path());
    if (files.size() == kMostListed) error = std::make_error_code(std::errc::value_too_large);
  }
  std::ranges::sort(files);
  return files;
}

/// Reads a file of a folder in which the service may write: a link there may lead to any file.
Result<std::string> read_no_link(const fs::path& file) {
  const hal::FileDescriptor opened = hal::open_no_link(file);
  if (opened.is_open()) return hal::read_regular_file(opened, file);
  return fail(errno == ELOOP ? "is a link"
                             : "cannot be opened: " + std::system_category().message(errno));
}

std::string bare_text(const std::string& text, const fs::path& file) {
  return without_comments(text, file.filename().string());
}

/// Line with mode, owner, group, size and name.
std::string listed(const fs::path& file, const fs::path& folder) {
  struct stat about {};
  const std::string name = file.lexically_relative(folder).string();
  if (::lstat(file.c_str(), &about) != 0) return name + "\n";
  std::array<char, 64> mode{};
  std::snprintf(mode.data(), mode.size(), "%06o %u:%u %lld ", about.st_mode, about.st_uid,
                about.st_gid, static_cast<long long>(about.st_size));
  return mode.data() + name + "\n";
}

/// Name in the support file.
std::string name_of(const fs::path& file, const fs::path& folder) {
  return files::is_lexically_below(file, folder)
             ? "configuration/" + file.lexically_relative(folder).string()
             : "elsewhere" + file.string();
}

/// Adds a file that the site does not name, or whose text it does not hold.
void add_from(const fs::path& file, const std::string& name, Collection& to) {
  if (!is_configuration(file)) {
    return to.leave_out(name, "not a file of the configuration, and may have a key");
  }
  to.add(name, read_no_link(file).map([&](const auto& text) { return bare_text(text, file); }));
}

/// Files and folders that a configuration names which cannot be read as one: all texts in quotes
/// that are paths of something.
std::vector<fs::path> places_in(const std::string& text, const fs::path& folder) {
  std::vector<fs::path> places;
  for (std::size_t at = 0; (at = text.find_first_of("\"'", at)) != text.npos; ++at) {
    const std::size_t end = text.find_first_of("\"'\n", at + 1);
    const std::string word = text.substr(at + 1, end - at - 1);
    std::error_code none;
    // The root folder and parents would be the whole system.
    const bool is_deep = std::ranges::count(word, '/') != 1 || !word.ends_with('/');
    if (is_deep && word.find("..") == word.npos && !word.empty() &&
        fs::exists(folder / word, none)) {
      places.push_back(folder / word);
    }
  }
  return places;
}

}  // namespace

SiteFolders site_folders(const fs::path& config, const files::Configuration* site,
                         const fs::path& lib) {
  SiteFolders folders;
  folders.configuration = fs::absolute(config).lexically_normal().parent_path();
  if (const auto state = state_folder(site != nullptr ? site->state_folder : "", config, lib)) {
    folders.state = *state;
  }
  if (site == nullptr) {
    const auto text = read_no_link(config);
    if (text) folders.keys = places_in(*text, folders.configuration);
    return folders;
  }
  const auto& web = std::get<WebSettings>(site->sinks);
  const auto& dds = std::get<DdsSettings>(site->sinks);
  if (!web.key.empty()) folders.keys.push_back(web.key);
  if (dds.security) folders.keys.push_back(dds.security->folder);
  folders.profile = dds.profile;
  return folders;
}

KnownSecrets secrets_of(const SiteFolders& folders, const fs::path& proc,
                        std::string_view environment) {
  KnownSecrets secrets;
  find_secrets(folders.configuration, secrets);
  if (folders.state) find_secrets(*folders.state, secrets);
  for (const fs::path& folder : folders.keys) find_secrets(folder, secrets);
  find_secrets_of_environment(environment, secrets);
  for (const fs::path& process : doctor::processes_of(proc, "orbwatchd")) {
    const auto of_daemon = hal::read_regular_file(process / "environ");
    if (of_daemon) {
      find_secrets_of_environment(*of_daemon, secrets);
    } else {
      secrets.unread.push_back(of_daemon.error().message);
    }
  }
  return secrets;
}

void add_configuration(const SiteFolders& folders, const files::FileTexts& texts, Collection& to) {
  const fs::path& folder = folders.configuration;
  std::set<fs::path> added;
  for (const auto& [path, text] : texts) {
    const fs::path file = fs::absolute(path).lexically_normal();
    if (added.insert(file).second) to.add(name_of(file, folder), bare_text(text, file));
  }
  std::error_code error;
  std::vector<fs::path> others = files_below(folder, error);
  if (error) to.leave_out("configuration/", folder.string() + ": " + error.message());
  if (!folders.profile.empty()) {
    others.push_back(fs::absolute(folders.profile).lexically_normal());
  }
  for (const fs::path& file : others) {
    if (added.insert(file).second) add_from(file, name_of(file, folder), to);
  }
}

void add_state(const SiteFolders& folders, Collection& to) {
  if (!folders.state) return to.leave_out("state/", "its folder is of another configuration");
  std::error_code error;
  std::string list;
  for (const fs::path& file : files_below(*folders.state, error)) {
    list += listed(file, *folders.state);
  }
  if (error) to.leave_out("state/", folders.state->string() + ": " + error.message());
  to.add("state/files.txt", list);
  for (const char* name : {"calibration.toml", "alarm-history.json"}) {
    if (fs::exists(*folders.state / name, error)) {
      to.add(std::string("state/") + name, read_no_link(*folders.state / name));
    }
  }
}

void add_snapshots(const fs::path& folder, Collection& to) {
  constexpr std::size_t kNewest = 4, kMostBytes = std::size_t{16} << 20;
  if (folder.empty()) return;
  std::vector<std::pair<fs::file_time_type, fs::path>> pictures;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->path().extension() == ".png" && it->is_regular_file(error)) {
      pictures.emplace_back(it->last_write_time(error), it->path());
    }
  }
  if (error) to.leave_out("pictures/snapshots/", folder.string() + ": " + error.message());
  std::ranges::sort(pictures, std::greater{});
  pictures.resize(std::min(pictures.size(), kNewest));
  for (const auto& [time, file] : pictures) {
    to.add_picture("pictures/snapshots/" + file.filename().string(),
                   hal::read_regular_file(file, kMostBytes));
  }
}

}  // namespace orbwatch::app::cli::support
