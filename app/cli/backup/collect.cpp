// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/collect.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <utility>

#include "app/daemon/configuration/replaceable_file.h"
#include "app/files/lexical_path.h"
#include "app/model/plain_text.h"
#include "app/model/status/utc_text.h"
#include "app/version.h"
#include "hal/host.h"
#include "hal/regular_file.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::cli::backup {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargest = std::size_t{16} << 20;
constexpr std::size_t kMostFiles = 2000;
constexpr std::size_t kLongestName = 255;
/// Permissions that are kept: a restored file is never writable by all.
constexpr mode_t kKept = 0775;

/// A file that cannot be a key; .xml is a network profile.
bool is_open_kind(const fs::path& file) {
  return daemon::is_configuration_name(file) || file.extension() == ".xml";
}

/// The folder of a second machine, of state or of recordings.
bool is_foreign(const fs::path& folder, const Site& site) {
  std::error_code none;
  const bool is_other_place = folder == site.places.state ||
                              std::ranges::find(site.recordings, folder) != site.recordings.end();
  return is_other_place || fs::exists(folder / "site.toml", none);
}

/// Adds the files of a site to a backup.
class Collector {
 public:
  Collector(const Site& site, Backup& backup) : site_(site), backup_(backup) {}

  Result<> add_configuration() {
    const auto names = configuration_names(site_);
    if (!names) return tl::unexpected(names.error());
    for (const std::string& name : *names) {
      const auto is_secret = [&](const ArchivedFile& read) {
        return (read.mode & 077U) == 0 || !is_open_kind(name) ||
               read.bytes.find("PRIVATE KEY-----") != std::string::npos;
      };
      if (auto added = add(name, is_secret); !added) return added;
    }
    return {};
  }

  Result<> add_state() {
    const auto names = state_names(site_);
    if (!names) return tl::unexpected(names.error());
    for (const std::string& name : *names) {
      const StateUse use = use_of(name.substr(kState.size()));
      if (use == StateUse::History) continue;
      auto added = add(name, [use](const auto&) { return use == StateUse::Secret; });
      if (!added) return added;
    }
    return {};
  }

  void list_named_elsewhere() {
    for (const fs::path& file : site_.named) {
      if (files::is_lexically_below(file, site_.places.configuration)) continue;
      leave_out(file, "is not in the folder of the configuration");
    }
  }

 private:
  void leave_out(const fs::path& file, const std::string& reason) {
    backup_.manifest.left_out.push_back(plain_text(file.string() + ": " + reason, 4096));
  }

  template <class IsSecret>
  Result<> add(const std::string& name, const IsSecret& is_secret) {
    const fs::path file = site_.places.at(name);
    struct stat about {};
    if (::lstat(file.c_str(), &about) != 0) {
      if (errno == ENOENT) return {};  // a temporary file that was renamed meanwhile
      return fail(file.string() + ": " + std::system_category().message(errno));
    }
    if (!S_ISREG(about.st_mode)) return left(file, "is a link or not a regular file");
    if (file.extension() == ".part") return left(file, "is being written");
    if (static_cast<std::size_t>(about.st_size) > kLargest) return left(file, "is too large");
    if (plain_text(name, kLongestName) != name || !check_backed_up(name)) {
      return left(file, "its name is not UTF-8, or is too long");
    }
    const hal::FileDescriptor opened = hal::open_no_link(file);
    if (!opened.is_open()) {
      return fail(file.string() + ": cannot be read: " + std::system_category().message(errno));
    }
    auto bytes = hal::read_regular_file(opened, file, kLargest);
    if (!bytes) return tl::unexpected(bytes.error());
    ArchivedFile read{name, std::move(*bytes), about.st_mode & kKept};
    (is_secret(read) ? backup_.secrets : backup_.files).push_back(std::move(read));
    return {};
  }

  Result<> left(const fs::path& file, const std::string& reason) {
    leave_out(file, reason);
    return {};
  }

  const Site& site_;
  Backup& backup_;
};

}  // namespace

Site site_of(const fs::path& file, const fs::path& state, const files::Configuration& configuration,
             const files::FileTexts& texts) {
  Site site{.file = full_path(file),
            .places = {full_path(file).parent_path(), full_path(state)},
            .recordings = {},
            .named = {}};
  const auto& sinks = configuration.sinks;
  for (const fs::path& folder :
       {std::get<SnapshotSettings>(sinks).folder, std::get<RecorderSettings>(sinks).folder}) {
    if (!folder.empty()) site.recordings.push_back(full_path(folder));
  }
  for (const auto& [path, text] : texts) site.named.push_back(full_path(path));
  const auto& web = std::get<WebSettings>(sinks);
  const auto& dds = std::get<DdsSettings>(sinks);
  for (const fs::path& path :
       {web.certificate, web.key, dds.profile, dds.security ? dds.security->folder : fs::path()}) {
    if (!path.empty()) site.named.push_back(full_path(path));
  }
  return site;
}

Result<std::vector<std::string>> configuration_names(const Site& site) {
  std::vector<std::string> names;
  std::error_code error;
  const fs::path& folder = site.places.configuration;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    if (!it->is_symlink(error) && it->is_directory(error)) {
      if (is_foreign(it->path(), site)) it.disable_recursion_pending();
      continue;
    }
    names.push_back(std::string(kConfiguration) + it->path().lexically_relative(folder).string());
    if (names.size() > kMostFiles) return fail(folder.string() + ": has too many files");
  }
  if (error) return fail(folder.string() + ": cannot be read: " + error.message());
  std::ranges::sort(names);
  return names;
}

Result<std::vector<std::string>> state_names(const Site& site) {
  std::vector<std::string> names;
  std::error_code error;
  const fs::path& folder = site.places.state;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const std::string file = it->path().filename().string();
    if (use_of(file) != StateUse::None) names.push_back(std::string(kState) + file);
  }
  if (error && error != std::errc::no_such_file_or_directory) {
    return fail(folder.string() + ": cannot be read: " + error.message());
  }
  std::ranges::sort(names);
  return names;
}

Result<Backup> collect(const Site& site) {
  Backup backup;
  backup.manifest.version = versions("orbwatch").front().second;
  backup.manifest.made = utc_text(std::chrono::system_clock::now()).value_or("");
  backup.manifest.host = hal::host_name();
  backup.manifest.site = site.file.filename().string();
  Collector collector(site, backup);
  if (auto added = collector.add_configuration(); !added) return tl::unexpected(added.error());
  if (auto added = collector.add_state(); !added) return tl::unexpected(added.error());
  collector.list_named_elsewhere();
  return backup;
}

}  // namespace orbwatch::app::cli::backup
