// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/configure/await_trial.h"
#include "app/cli/options/options.h"
#include "app/daemon/configuration/new_configuration.h"
#include "app/daemon/configuration/replaceable_file.h"
#include "app/files/lexical_path.h"
#include "app/files/resolve.h"
#include "app/files/runtime/site_file.h"
#include "app/files/runtime/trial.h"
#include "app/model/configuration/configuration_files.h"
#include "app/state/state_folder.h"

namespace orbwatch::app::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kConfigureUsage =
    "Usage: orbwatch configure FILE [--seconds N] [--dry-run]\n"
    "       orbwatch configure --confirm | --cancel\n"
    "\n"
    "Checks a new configuration file and all files that it names, shows what they change, has the\n"
    "running orbwatchd run them, and waits until it does or says why it does not. The installed\n"
    "files stay as they are until --confirm, which writes them. Without it orbwatchd goes back to\n"
    "them after N seconds, and after any end: a crash, a power cut. The files that FILE names "
    "stand\n"
    "in its folder, as they are to stand in the folder of the installed one.\n"
    "\n";

struct Options {
  fs::path config;
  std::string named;  ///< option that names it, for follow-up commands; empty: none did
  std::optional<int> seconds;
  bool dry_run = false;
  bool confirm = false;
  bool cancel = false;
};

/// Length of the trial, s.
int trial_of(const Options& o) { return o.seconds.value_or(kUsualTrial); }

/// The texts by their paths relative to the installed file. Error: one is not in the new one's
/// folder.
Result<files::FileTexts> placed(const files::FileTexts& texts, const fs::path& from,
                                const fs::path& to) {
  files::FileTexts moved;
  for (const auto& [path, text] : texts) {
    const bool is_below = files::is_lexically_below(path, from);
    if (path.is_absolute() && !is_below) continue;  // it keeps its place
    if (!is_below) {
      return fail(path.string() + ": is not in the folder of the configuration, " + from.string());
    }
    moved[(to / path.lexically_relative(from)).lexically_normal()] = text;
  }
  return moved;
}

/// The texts of the new files by their paths relative to the installed one, whose name may differ.
Result<files::FileTexts> new_texts(const fs::path& file, const fs::path& installed) {
  fs::path folder = file.parent_path();
  if (folder.empty()) folder = ".";
  const auto site = files::resolve(folder / file.filename());
  if (!site) return tl::unexpected(site.error());
  auto texts = placed(site->texts, folder, installed.parent_path());
  if (!texts) return texts;
  auto own = texts->extract((installed.parent_path() / file.filename()).lexically_normal());
  (*texts)[installed] = std::move(own.mapped());
  return texts;
}

/// Root may replace any file: a folder that another user has prepared must not make it replace a
/// key. Files with a configuration's extension may exist without being named yet.
Result<> check_places(const files::FileTexts& texts, const fs::path& config,
                      const fs::path& folder) {
  std::vector<fs::path> state{folder};
  std::set<fs::path> named{config};
  if (const auto present = files::resolve(config)) {
    if (!present->state_folder.empty()) state.push_back(present->state_folder);
    for (const auto& [path, text] : present->texts) named.insert(path);
  }
  for (const auto& [path, text] : texts) {
    if (daemon::is_configuration_name(path)) named.insert(path);
    if (auto allowed = daemon::check_replaceable(path, config, named, state); !allowed)
      return allowed;
  }
  return {};
}

/// `folder` belongs to the orbwatchd that runs the installed file.
Result<std::string> try_out(const Options& o, const fs::path& file, const fs::path& folder) {
  const auto texts = new_texts(file, o.config);
  if (!texts) return tl::unexpected(texts.error());
  if (const auto allowed = check_places(*texts, o.config, folder); !allowed) {
    return tl::unexpected(allowed.error());
  }
  const auto trial = daemon::checked_trial(o.config, *texts, trial_of(o));
  if (!trial) return tl::unexpected(trial.error());
  std::string difference;
  for (const auto& [path, lines] : daemon::differences_from_files(trial->texts))
    difference += lines;
  if (difference.empty()) return "changes nothing\n";
  if (o.dry_run) return difference;
  const auto runs = [&] { return await_trial(folder, unit_of(o.config)); };
  return request_trial(folder, *trial).and_then(runs).map([&] {
    return difference + "runs for " + std::to_string(trial_of(o)) +
           " seconds from now on; keep it with: sudo orbwatch configure --confirm" + o.named + "\n";
  });
}

Result<std::string> confirm(const fs::path& folder) {
  return files::confirm_trial(folder).map([](const std::vector<fs::path>& written) {
    std::string text;
    for (const fs::path& path : written) text += path.string() + ": written\n";
    return text;
  });
}

CliResult<std::string> run(Options o, const std::vector<std::string>& words) {
  const bool is_named = !o.config.empty();
  o.config = fs::absolute(files::site_file(o.config)).lexically_normal();
  if (is_named) o.named = " --config " + o.config.string();
  const std::size_t ways = words.size() + (o.confirm ? 1 : 0) + (o.cancel ? 1 : 0);
  if (ways != 1) return usage_error("pass FILE, --confirm or --cancel");
  if (words.empty() && (o.dry_run || o.seconds)) {
    return usage_error("--dry-run and --seconds are for FILE");
  }
  const auto folder = state_folder({}, o.config);
  if (!folder) return tl::unexpected(folder.error());
  if (o.confirm) return confirm(*folder);
  if (o.cancel) return files::cancel_trial(*folder).map([] { return std::string("goes back\n"); });
  const int seconds = trial_of(o);
  if (seconds < kShortestTrial || seconds > kLongestTrial) {
    return usage_error("--seconds is " + std::to_string(seconds) + "; it must be from 10 to 3600");
  }
  return try_out(o, words.front(), *folder);
}

std::function<Result<>(const std::string&)> seconds_option(std::optional<int>& target) {
  return [&target](const std::string& value) {
    return parse_whole("seconds", value).map([&target](int seconds) { target = seconds; });
  };
}

}  // namespace

CliResult<std::string> configure_command(const Arguments& arguments) {
  Options o;
  return run_command(
      arguments,
      {.usage = kConfigureUsage,
       .options = {{"config", 'c', "FILE", "the installed file (default: as orbwatchd)",
                    text_option(o.config)},
                   {"seconds", 0, "N", "until it goes back, 10 to 3600 (default 60)",
                    seconds_option(o.seconds)},
                   {"dry-run", 0, "", "check and show the difference only", flag_option(o.dry_run)},
                   {"confirm", 0, "", "keep what runs: write the files", flag_option(o.confirm)},
                   {"cancel", 0, "", "go back now", flag_option(o.cancel)}},
       .takes_words = true},
      [&](const auto& words) { return run(o, words); });
}

}  // namespace orbwatch::app::cli
