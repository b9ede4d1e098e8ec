// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/configuration/installed_configuration.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <set>
#include <system_error>
#include <utility>

#include "app/daemon/configuration/new_configuration.h"
#include "app/daemon/configuration/replaceable_file.h"
#include "app/files/recipe/recipe_edit.h"
#include "app/files/text/file_version.h"

namespace orbwatch::app::daemon {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const files::Resolved& site) {
  std::vector<fs::path> files;
  for (const auto& [file, text] : site.texts) files.push_back(file);
  return files;
}

/// It is beside the configuration file, by the one name that it has: "./site.toml" would be another
/// name for one that is guarded.
bool may_be_changed(const fs::path& file, const fs::path& site) {
  const auto name = name_beside(site, file);
  return name && !name->empty() && fs::path(*name).lexically_normal() == *name &&
         site.parent_path() / *name == file && fs::path(*name).has_filename() && *name != ".";
}

/// Eight hexadecimal digits.
std::string checksum_digits(const std::string& text) {
  char digits[16];
  std::snprintf(digits, sizeof digits, "%08x", files::checksum_of(text));
  return digits;
}

/// Error: not a result of checksum_digits().
Result<std::uint32_t> parse_checksum(const std::string& name, const std::string& digits) {
  std::uint32_t checksum = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, checksum, 16);
  if (error == std::errc() && stop == end) return checksum;
  return fail(name + ": \"" + digits + "\" is not a checksum of eight hexadecimal digits");
}

/// The file's version with the checksum of this very text, which was read before.
ConfigurationFiles::Version version_of_text(const fs::path& file, const std::string& text) {
  files::FileVersion now = files::version_of(file);
  return {checksum_digits(text), std::move(now.time), std::move(now.account)};
}

/// Before it is tried out, not when it is confirmed: a file is replaced by one in the same folder.
Result<> check_writable(const fs::path& file) {
  const fs::path parent = file.parent_path(), folder = parent.empty() ? "." : parent;
  if (::access(folder.c_str(), W_OK) == 0) return {};
  return fail(folder.string() + ": orbwatchd may not write there (" +
              std::system_category().message(errno) +
              "); let its user, or use `orbwatch configure` on the board");
}

}  // namespace

InstalledConfiguration::InstalledConfiguration(fs::path file, const Chosen& chosen)
    : file_(std::move(file)), refusal_(chosen.refusal), files_(files_of(chosen.site)) {}

std::set<fs::path> InstalledConfiguration::named_files() const {
  std::set<fs::path> all(files_.begin(), files_.end());
  all.insert(file_);
  if (const auto present = files::resolve(file_)) {
    for (const fs::path& file : files_of(*present)) all.insert(file);
  }
  return all;
}

/// The service's, and the one that the configuration file names.
std::vector<fs::path> InstalledConfiguration::state_folders() const {
  std::vector<fs::path> folders;
  if (folder_) folders.push_back(*folder_);
  if (const auto site = files::read_site(file_); site && !site->state_folder.empty()) {
    folders.push_back(site->state_folder);
  }
  return folders;
}

Result<ConfigurationFiles::State> InstalledConfiguration::read() const {
  State state{name_of(file_), {}, {}, refusal_};
  for (const fs::path& file : named_files()) {
    if (is_private(file)) {
      state.outside[name_of(file)] = kPrivateText;
      continue;
    }
    files::TextFiles files;
    auto text = files.read(file, "a file of the configuration");
    std::error_code none;                                    // `text` says what is wrong
    const bool is_to_be = !fs::exists(file, none) && !none;  // by a trial
    if (!text && is_to_be) continue;
    if (!text) return tl::unexpected(text.error());
    if (may_be_changed(file, file_)) state.versions[name_of(file)] = version_of_text(file, *text);
    (may_be_changed(file, file_) ? state.files : state.outside)[name_of(file)] = std::move(*text);
  }
  if (!folder_) return state;
  auto trial = files::running_trial(*folder_);
  if (trial && !*trial) trial = files::requested_trial(*folder_);
  if (!trial) return tl::unexpected(trial.error());
  if (!*trial) return state;
  state.trial.emplace();
  state.owner = (*trial)->owner;
  for (const auto& [file, text] : (*trial)->texts) (*state.trial)[name_of(file)] = text;
  const hal::TimePoint end = trial_end_;
  if (end != hal::TimePoint{}) {
    state.seconds_left = std::chrono::duration<double>(end - hal::Clock::now()).count();
  }
  return state;
}

Result<ConfigurationFiles::Edit> InstalledConfiguration::with_changed_recipe(
    int number, const RecipeChange& change) const {
  const auto site = files::read_site(file_);
  if (!site) return tl::unexpected(site.error());
  const auto recipe = std::ranges::find(site->recipes, number, &files::RecipeFile::number);
  if (recipe == site->recipes.end()) {
    return fail(file_.string() + ": names no recipe " + std::to_string(number));
  }
  const fs::path& file = recipe->file.path;
  if (!may_be_changed(file, file_)) {
    return fail(file.string() +
                ": is outside of the configuration's folder; change it on the board");
  }
  files::TextFiles files;
  const auto present = files.read(file, "a TOML file");
  if (!present) return tl::unexpected(present.error());
  const std::string name = name_of(file);
  auto edit = files::changed_recipe(*present, name, change).map([&](const std::string& text) {
    return Edit{{{name, text}}, {{name, checksum_digits(*present)}}};
  });
  if (!change.copy || !edit) return edit;
  return with_copied_recipe(file, *change.copy, std::move(*edit));
}

/// `changed`: the edit as if the recipe itself was changed.
Result<ConfigurationFiles::Edit> InstalledConfiguration::with_copied_recipe(const fs::path& recipe,
                                                                            const RecipeCopy& copy,
                                                                            Edit changed) const {
  if (auto right = files::check_recipe_name(copy.name); !right) {
    return tl::unexpected(right.error());
  }
  const std::string name = name_of(recipe.parent_path() / (copy.name + ".toml"));
  std::error_code error;
  if (fs::exists(file_.parent_path() / name, error) || error) {
    return fail(name + ": exists already; choose another name");
  }
  files::TextFiles files;
  const auto site = files.read(file_, "the configuration file");
  if (!site) return tl::unexpected(site.error());
  const std::string site_name = name_of(file_);
  return files::with_recipe(*site, site_name, copy.number, name).map([&](std::string text) {
    Edit edit{{{name, std::move(changed.texts.begin()->second)}, {site_name, std::move(text)}},
              std::move(changed.based_on)};
    edit.based_on[site_name] = checksum_digits(*site);
    return edit;
  });
}

Result<ConfigurationFiles::Change> InstalledConfiguration::check(const Texts& texts) const {
  return placed(texts)
      .and_then([this](const files::FileTexts& there) {
        return checked_trial(file_, there, kUsualTrial);
      })
      .map([this](const files::Trial& trial) { return change_of(trial); });
}

Result<ConfigurationFiles::Change> InstalledConfiguration::try_out(const Edit& edit, int seconds) {
  const auto folder = trial_folder();
  if (!folder) return tl::unexpected(folder.error());
  const auto running = files::running_trial(*folder);
  if (!running) return tl::unexpected(running.error());
  if (*running || files::is_trial_requested(*folder)) {
    return fail("another new configuration waits for its confirmation: confirm or revert it first");
  }
  if (const auto finished = files::finish_confirmed(*folder); !finished) {
    return tl::unexpected(finished.error());
  }
  const auto there = placed(edit.texts);
  if (!there) return tl::unexpected(there.error());
  const auto basis = checksums_in(edit.based_on);
  if (!basis) return tl::unexpected(basis.error());
  auto trial = checked_trial(file_, *there, seconds, *basis);
  if (!trial) return tl::unexpected(trial.error());
  trial->owner = edit.owner;
  Change change = change_of(*trial);
  if (change.files.empty()) return fail("these texts change nothing");
  for (const std::string& name : change.files) {
    if (auto writable = check_writable(file_.parent_path() / name); !writable) {
      return tl::unexpected(writable.error());
    }
  }
  return request_trial(*folder, *trial).map([&] { return std::move(change); });
}

Result<std::vector<std::string>> InstalledConfiguration::confirm() {
  return trial_folder()
      .and_then([](const fs::path& folder) { return files::confirm_trial(folder); })
      .map([this](const std::vector<fs::path>& written) {
        std::vector<std::string> names;
        names.reserve(written.size());
        for (const fs::path& file : written) names.push_back(name_of(file));
        return names;
      });
}

Result<> InstalledConfiguration::revert() {
  return trial_folder().and_then(
      [](const fs::path& folder) { return files::cancel_trial(folder); });
}

/// By their places beside the configuration file.
Result<files::FileTexts> InstalledConfiguration::placed(const Texts& texts) const {
  if (texts.empty()) return fail("no texts were sent");
  const std::set<fs::path> named = named_files();
  const std::vector<fs::path> state = state_folders();
  files::FileTexts there;
  for (const auto& [name, text] : texts) {
    const fs::path file = file_.parent_path() / name;
    // A file has one name here, by which the desk knows the one that is guarded.
    const bool is_its_name = name_beside(file_, file) == name;
    if (!is_its_name || !may_be_changed(file, file_) || name.find('\0') != std::string::npos) {
      return fail(name + ": must be a relative path inside the configuration's folder");
    }
    if (const auto allowed = check_replaceable(file, file_, named, state); !allowed) {
      return tl::unexpected(allowed.error());
    }
    there[file] = text;
  }
  return there;
}

Result<files::FileChecksums> InstalledConfiguration::checksums_in(const Basis& based_on) const {
  files::FileChecksums checksums;
  for (const auto& [name, digits] : based_on) {
    const auto checksum = parse_checksum(name, digits);
    if (!checksum) return tl::unexpected(checksum.error());
    checksums[file_.parent_path() / name] = *checksum;
  }
  return checksums;
}

Result<fs::path> InstalledConfiguration::trial_folder() const {
  if (folder_) return *folder_;
  return fail(
      "orbwatchd runs without STATE_DIRECTORY, in which a service keeps what it goes back to; "
      "change the files and send the command restart");
}

ConfigurationFiles::Change InstalledConfiguration::change_of(const files::Trial& trial) const {
  Change change;
  for (const auto& [file, lines] : differences_from_files(trial.texts)) {
    change.files.push_back(name_of(file));
    change.difference += lines;
  }
  return change;
}

std::string InstalledConfiguration::name_of(const fs::path& file) const {
  return name_beside(file_, file).value_or(file.string());
}

}  // namespace orbwatch::app::daemon
