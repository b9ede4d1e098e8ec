// SPDX-License-Identifier: Apache-2.0
#include "app/files/runtime/trial.h"

#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "app/files/text/file_version.h"
#include "app/files/text/text_file.h"
#include "hal/atomic_file.h"
#include "hal/made_folder.h"
#include "hal/regular_file.h"

namespace orbwatch::app::files {
namespace {

namespace fs = std::filesystem;

fs::path requested_in(const fs::path& folder) { return folder / kRequestedTrial; }
fs::path running_in(const fs::path& folder) { return folder / kRunningTrial; }
fs::path confirmed_in(const fs::path& folder) { return folder / kConfirmedTrial; }
fs::path report_in(const fs::path& folder) { return folder / "trial-report.json"; }

/// Parses a file; `parse` may throw the exceptions of the JSON library. Nullopt: no such file.
template <class Parsed>
Result<std::optional<Parsed>> read_json(const fs::path& file,
                                        Parsed (*parse)(const nlohmann::json&)) {
  std::error_code none;  // read_regular_file() reports the error
  if (!fs::exists(file, none) && !none) return std::nullopt;
  const auto text = hal::read_regular_file(file, kMostTexts);
  if (!text) return tl::unexpected(text.error());
  try {
    return parse(nlohmann::json::parse(*text));
  } catch (const nlohmann::json::exception&) {
    return fail(file.string() + ": is damaged");
  }
}

/// Error: a file that the confirmation would overwrite differs from the one that the trial was
/// based on.
Result<> check_unchanged(const Trial& trial) {
  for (const auto& [path, checksum] : trial.based_on) {
    const FileVersion now = version_of(path);
    if (now.checksum == checksum) continue;
    const auto text = trial.texts.find(path);
    const auto present = hal::read_regular_file(path);
    if (present && text != trial.texts.end() && *present == text->second) continue;
    return fail(change_text(path.string(), now) +
                " since the new configuration was made, which does not have that change: nothing "
                "is written; go back, and change the files as they are now");
  }
  return {};
}

Trial trial_of(const nlohmann::json& json) {
  Trial trial{json.at("site").get<std::string>(), {}, json.at("seconds").get<int>()};
  for (const auto& [path, kept] : json.at("files").items()) {
    trial.texts[path] = kept.get<std::string>();
  }
  // These keys are absent in a trial that an older version requested.
  trial.owner = json.value("owner", "");
  const auto based_on = json.find("based_on");
  if (based_on == json.end()) return trial;
  for (const auto& [path, checksum] : based_on->items()) {
    trial.based_on[path] = checksum.get<std::uint32_t>();
  }
  return trial;
}

std::string refusal_of(const nlohmann::json& json) { return json.at("refusal").get<std::string>(); }

Result<std::optional<Trial>> read(const fs::path& file) { return read_json<Trial>(file, trial_of); }

}  // namespace

FileChecksums checksums_of(const FileTexts& texts) {
  std::map<fs::path, std::uint32_t> checksums;
  for (const auto& [path, text] : texts) checksums[path] = version_of(path).checksum;
  return checksums;
}

Result<> request_trial(const fs::path& folder, const Trial& trial) {
  nlohmann::json files = nlohmann::json::object();
  for (const auto& [path, text] : trial.texts) files[path.string()] = text;
  nlohmann::json based_on = nlohmann::json::object();
  for (const auto& [path, checksum] : trial.based_on) based_on[path.string()] = checksum;
  const nlohmann::json json{{"site", trial.site.string()},
                            {"seconds", trial.seconds},
                            {"files", files},
                            {"based_on", based_on},
                            {"owner", trial.owner}};
  std::error_code none;  // belongs to a previous request
  fs::remove(report_in(folder), none);
  try {
    return hal::write_file(requested_in(folder), json.dump(1) + "\n", hal::FileAccess::Owner);
  } catch (const nlohmann::json::type_error&) {
    return fail(trial.site.string() + ": it or a file that it names is not UTF-8");
  }
}

bool is_trial_requested(const fs::path& folder) {
  std::error_code none;
  return fs::exists(requested_in(folder), none);
}

Result<std::optional<Trial>> requested_trial(const fs::path& folder) {
  return read(requested_in(folder));
}

void drop_request(const fs::path& folder) {
  std::error_code none;
  fs::remove(requested_in(folder), none);
}

Result<std::optional<Trial>> take_trial(const fs::path& folder) {
  std::error_code error;
  fs::rename(requested_in(folder), running_in(folder), error);
  if (error == std::errc::no_such_file_or_directory) return std::nullopt;
  if (error) return fail(requested_in(folder).string() + ": " + error.message());
  // Without the sync, a trial that resets the board would be requested again at each boot.
  if (auto taken = hal::sync_folder(folder); !taken) return tl::unexpected(taken.error());
  return running_trial(folder);
}

Result<std::optional<Trial>> running_trial(const fs::path& folder) {
  return read(running_in(folder));
}

Result<std::vector<fs::path>> confirm_trial(const fs::path& folder) {
  const auto running = running_trial(folder);
  if (!running) return tl::unexpected(running.error());
  if (*running) {
    if (auto unchanged = check_unchanged(**running); !unchanged) {
      return tl::unexpected(unchanged.error());
    }
  }
  std::error_code error;
  fs::rename(running_in(folder), confirmed_in(folder), error);
  if (error && error != std::errc::no_such_file_or_directory) {
    return fail(running_in(folder).string() + ": " + error.message());
  }
  if (!error) {
    if (auto kept = hal::sync_folder(folder); !kept) return tl::unexpected(kept.error());
  }
  auto written = finish_confirmed(folder);
  if (!written) return tl::unexpected(written.error());
  if (*written) return std::move(**written);
  return fail(
      "no configuration waits for its confirmation: it was confirmed already, went back or was "
      "not taken up");
}

Result<std::optional<Trial>> confirmed_trial(const fs::path& folder) {
  return read(confirmed_in(folder));
}

Result<std::optional<std::vector<fs::path>>> finish_confirmed(const fs::path& folder) {
  const auto trial = confirmed_trial(folder);
  if (!trial) return tl::unexpected(trial.error());
  if (!*trial) return std::nullopt;
  std::vector<fs::path> written;
  const auto write = [&written](const fs::path& path, const std::string& text) -> Result<> {
    const auto present = hal::read_regular_file(path);
    if (present && *present == text) return {};
    written.push_back(path);
    return hal::make_folders_above(path).and_then(
        [&] { return hal::write_file(path, text, hal::FileAccess::Folder); });
  };
  for (const auto& [path, text] : (*trial)->texts) {
    if (path == (*trial)->site) continue;
    if (auto done = write(path, text); !done) return tl::unexpected(done.error());
  }
  const auto site = (*trial)->texts.find((*trial)->site);
  if (site != (*trial)->texts.end()) {
    if (auto done = write(site->first, site->second); !done) return tl::unexpected(done.error());
  }
  std::error_code none;
  fs::remove(confirmed_in(folder), none);
  return written;
}

Result<> report_trial(const fs::path& folder, const std::string& refusal) {
  constexpr auto kReplace = nlohmann::json::error_handler_t::replace;  // a message may quote a file
  return hal::write_file(report_in(folder),
                         nlohmann::json{{"refusal", refusal}}.dump(1, ' ', false, kReplace) + "\n",
                         hal::FileAccess::Owner);
}

Result<std::optional<std::string>> trial_report(const fs::path& folder) {
  return read_json<std::string>(report_in(folder), refusal_of);
}

bool end_trial(const fs::path& folder) {
  std::error_code none;
  return fs::remove(running_in(folder), none);
}

Result<> cancel_trial(const fs::path& folder) {
  std::error_code none;
  // This order is required: the daemon may take the requested one in between.
  const bool was_requested = fs::remove(requested_in(folder), none);
  if (end_trial(folder) || was_requested) return {};
  return fail("no configuration waits for its confirmation");
}

}  // namespace orbwatch::app::files
