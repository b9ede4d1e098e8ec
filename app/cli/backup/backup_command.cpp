// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "app/cli/backup/backup_file.h"
#include "app/cli/backup/collect.h"
#include "app/cli/backup/events/event_room.h"
#include "app/cli/backup/events/kept_events.h"
#include "app/cli/backup/passphrase.h"
#include "app/cli/command.h"
#include "app/cli/options/options.h"
#include "app/files/resolve.h"
#include "app/files/runtime/site_file.h"
#include "app/files/runtime/trial.h"
#include "app/ports/recorder/recorder_settings.h"
#include "app/state/state_folder.h"
#include "hal/atomic_file.h"

namespace orbwatch::app::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBackupUsage =
    "Usage: orbwatch backup -o FILE [options]\n\n"
    "Writes configuration, recipes, alignments, users, certificates and keys into one file, from\n"
    "which `orbwatch restore` makes another device take over. Secrets are encrypted with a\n"
    "passphrase, which is asked for twice, or left out by --without-secrets. --with-events adds\n"
    "the events of the recorder that are kept; other recordings are not in it. Run it as root,\n"
    "who may read all. FILE is accessible to its owner only.\n\n";

struct BackupOptions {
  fs::path output;
  fs::path config;
  fs::path passphrase_file;
  bool without_secrets = false;
  bool with_events = false;
};

/// A backup, and the events of its manifest.
struct Collected {
  backup::Backup backup;
  std::vector<recorder::StoredEvent> events{};
  std::uint64_t reserve = 0;  ///< bytes of a disk that remain free beside events
};

Result<Collected> collected(const fs::path& config, bool with_events) {
  const auto site = files::resolve(config);
  if (!site) return tl::unexpected(site.error());
  const auto state = state_folder(site->site.state_folder, config);
  if (!state) return tl::unexpected(state.error());
  const auto confirmed = files::confirmed_trial(*state);
  if (!confirmed) return tl::unexpected(confirmed.error());
  if (*confirmed) return fail("a configuration is being written; try again when orbwatchd runs");
  auto backup = backup::collect(backup::site_of(config, *state, site->site, site->texts));
  if (!backup) return tl::unexpected(backup.error());
  if (!with_events) return Collected{std::move(*backup)};
  backup::Manifest& manifest = backup->manifest;
  const auto& recorder = std::get<RecorderSettings>(site->site.sinks);
  if (recorder.folder.empty()) {
    manifest.left_out.emplace_back("kept events: the configuration has no folder in [recorder]");
    return Collected{std::move(*backup)};
  }
  auto events = recorder::EventFolder(recorder.folder)
                    .list()
                    .and_then([&](std::vector<recorder::StoredEvent> all) {
                      return backup::kept_events(std::move(all), manifest.left_out);
                    });
  if (!events) return tl::unexpected(events.error());
  manifest.events = backup::manifest_events(*events);
  return Collected{std::move(*backup), std::move(*events),
                   static_cast<std::uint64_t>(recorder.reserve_mib) << 20};
}

/// Says who may read a file that this user may not.
Error advised(Error error) {
  const bool is_denied =
      error.message.find(std::system_category().message(EACCES)) != std::string::npos;
  if (is_denied && ::geteuid() != 0) error.message += "; run it as root: sudo orbwatch backup";
  return error;
}

/// Writes the file, which appears as a whole. Ctrl-C ends it without a file.
Result<> write_backup(const fs::path& output, const std::string& bytes, const Collected& all) {
  const std::atomic<bool>& is_cancelled = cancelled_by_signal();
  auto file = hal::AtomicFile::create(output, hal::FileAccess::Owner);
  if (!file) return tl::unexpected(file.error());
  const auto sink = [&](std::string_view part) -> Result<> {
    if (is_cancelled) return fail("cancelled; no file is written");
    return file->write(part);
  };
  const auto& events = all.backup.manifest.events;
  return backup::check_room(events, fs::absolute(output).parent_path(), all.reserve)
      .and_then([&] { return sink(bytes); })
      .and_then([&] { return backup::write_events(all.events, events, sink); })
      .and_then([&] { return file->place(); });
}

std::string report(const BackupOptions& o, const backup::Backup& backup, bool is_encrypted) {
  std::string text = o.output.string() + ": " + std::to_string(backup.files.size()) + " files, " +
                     std::to_string(backup.secrets.size()) + " secret ones " +
                     (is_encrypted ? "encrypted" : "left out") + "\n";
  for (const ArchivedFile& file : backup.secrets) {
    text += (is_encrypted ? "  encrypted  " : "  left out   ") + file.name + "\n";
  }
  for (const backup::ManifestEvent& event : backup.manifest.events) {
    text += "  event      " + event.name + ", " + std::to_string(event.bytes) + " bytes\n";
  }
  for (const std::string& line : backup.manifest.left_out) text += "  left out   " + line + "\n";
  return text;
}

CliResult<std::string> back_up(const BackupOptions& o) {
  if (o.output.empty()) return usage_error("-o FILE is missing");
  if (o.without_secrets && !o.passphrase_file.empty()) {
    return usage_error("--passphrase-file has no use with --without-secrets");
  }
  const auto all =
      collected(fs::absolute(files::site_file(o.config)).lexically_normal(), o.with_events);
  if (!all) return tl::unexpected(advised(all.error()));
  const bool is_encrypted = !o.without_secrets && !all->backup.secrets.empty();
  const auto passphrase =
      is_encrypted ? backup::new_passphrase(o.passphrase_file) : Result<std::string>("");
  if (!passphrase) return tl::unexpected(passphrase.error());
  return backup::backup_bytes(all->backup, *passphrase)
      .and_then([&](const std::string& bytes) { return write_backup(o.output, bytes, *all); })
      .map([&] { return report(o, all->backup, is_encrypted); });
}

}  // namespace

CliResult<std::string> backup_command(const Arguments& arguments) {
  BackupOptions o;
  return run_command(
      arguments,
      {.usage = kBackupUsage,
       .options = {{"output", 'o', "FILE", "archive to write, such as backup.tar.zst",
                    text_option(o.output)},
                   {"config", 'c', "SITE", "the file that orbwatchd runs (default: as orbwatchd)",
                    text_option(o.config)},
                   {"passphrase-file", 0, "FILE", "its first line, instead of asking",
                    text_option(o.passphrase_file)},
                   {"without-secrets", 0, "", "leave out users, certificates and keys",
                    flag_option(o.without_secrets)},
                   {"with-events", 0, "", "also the kept events of the recorder",
                    flag_option(o.with_events)}}},
      [&](const auto&) { return back_up(o); });
}

}  // namespace orbwatch::app::cli
