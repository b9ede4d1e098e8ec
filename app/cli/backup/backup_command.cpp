// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <string>

#include "app/cli/backup/backup_file.h"
#include "app/cli/backup/collect.h"
#include "app/cli/backup/passphrase.h"
#include "app/cli/command.h"
#include "app/cli/options/options.h"
#include "app/files/resolve.h"
#include "app/files/runtime/site_file.h"
#include "app/files/runtime/trial.h"
#include "app/state/state_folder.h"
#include "hal/atomic_file.h"

namespace orbwatch::app::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBackupUsage =
    "Usage: orbwatch backup -o FILE [options]\n\n"
    "Writes configuration, recipes, alignments, users, certificates and keys into one file, from\n"
    "which `orbwatch restore` makes another device take over. Secrets are encrypted with a\n"
    "passphrase, which is asked for twice, or left out by --without-secrets. Recordings are not "
    "in\n"
    "it. Run it as root, who may read all. FILE is accessible to its owner only.\n\n";

struct BackupOptions {
  fs::path output;
  fs::path config;
  fs::path passphrase_file;
  bool without_secrets = false;
};

Result<backup::Backup> collected(const fs::path& config) {
  const auto site = files::resolve(config);
  if (!site) return tl::unexpected(site.error());
  const auto state = state_folder(site->site.state_folder, config);
  if (!state) return tl::unexpected(state.error());
  const auto confirmed = files::confirmed_trial(*state);
  if (!confirmed) return tl::unexpected(confirmed.error());
  if (*confirmed) return fail("a configuration is being written; try again when orbwatchd runs");
  return backup::collect(backup::site_of(config, *state, site->site, site->texts));
}

std::string report(const BackupOptions& o, const backup::Backup& backup, bool is_encrypted) {
  std::string text = o.output.string() + ": " + std::to_string(backup.files.size()) + " files, " +
                     std::to_string(backup.secrets.size()) + " secret ones " +
                     (is_encrypted ? "encrypted" : "left out") + "\n";
  for (const ArchivedFile& file : backup.secrets) {
    text += (is_encrypted ? "  encrypted  " : "  left out   ") + file.name + "\n";
  }
  for (const std::string& line : backup.manifest.left_out) text += "  left out   " + line + "\n";
  return text;
}

CliResult<std::string> back_up(const BackupOptions& o) {
  if (o.output.empty()) return usage_error("-o FILE is missing");
  if (o.without_secrets && !o.passphrase_file.empty()) {
    return usage_error("--passphrase-file has no use with --without-secrets");
  }
  const auto backup = collected(fs::absolute(files::site_file(o.config)).lexically_normal());
  if (!backup) return tl::unexpected(backup.error());
  const bool is_encrypted = !o.without_secrets && !backup->secrets.empty();
  const auto passphrase =
      is_encrypted ? backup::new_passphrase(o.passphrase_file) : Result<std::string>("");
  if (!passphrase) return tl::unexpected(passphrase.error());
  return backup::backup_bytes(*backup, *passphrase)
      .and_then([&](const std::string& bytes) {
        return hal::write_file(o.output, bytes, hal::FileAccess::Owner);
      })
      .map([&] { return report(o, *backup, is_encrypted); });
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
                    flag_option(o.without_secrets)}}},
      [&](const auto&) { return back_up(o); });
}

}  // namespace orbwatch::app::cli
