// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/configuration/new_configuration.h"

#include "app/daemon/configuration/replaceable_file.h"
#include "app/daemon/site/site_check.h"
#include "app/files/resolve.h"
#include "app/files/text/text_difference.h"

namespace orbwatch::app::daemon {

namespace fs = std::filesystem;

std::optional<std::string> name_beside(const fs::path& site, const fs::path& file) {
  const fs::path folder = site.parent_path();
  const fs::path name = folder.empty() ? file : file.lexically_relative(folder);
  if (name.empty() || name.is_absolute()) return std::nullopt;
  for (const fs::path& part : name) {
    if (part == "..") return std::nullopt;
  }
  return name.string();
}

Result<files::Trial> checked_trial(const fs::path& site, const files::FileTexts& texts, int seconds,
                                   files::FileChecksums based_on) {
  based_on.merge(
      files::checksums_of(texts));  // before the rest is read and checked, which takes time
  const auto resolved = files::resolve(site, texts);
  if (!resolved) return tl::unexpected(resolved.error());
  if (const auto checked = check_site(*resolved, Dates::Checked); !checked) {
    return tl::unexpected(checked.error());
  }
  for (const auto& [file, text] : texts) {
    if (!resolved->texts.contains(file)) {
      return fail(file.string() + ": no file of the configuration names it");
    }
  }
  files::Trial trial{site, {}, seconds};
  for (const auto& [file, text] : resolved->texts) {
    // A secret that the configuration names stays where it is, and is not repeated anywhere.
    const bool is_kept = texts.contains(file) || !is_private(file);
    if (!is_kept || !name_beside(site, file)) continue;
    trial.texts[file] = text;
    const auto replaced = based_on.find(file);
    trial.based_on[file] = replaced == based_on.end() ? files::checksum_of(text) : replaced->second;
  }
  return trial;
}

std::map<fs::path, std::string> differences_from_files(const files::FileTexts& texts) {
  std::map<fs::path, std::string> all;
  for (const auto& [file, text] : texts) {
    files::TextFiles files;
    const auto old = files.read(file, "a text file");
    const bool is_same = old && *old == text;
    if (!is_same) all[file] = files::text_difference(old.value_or(""), text, file.string());
  }
  return all;
}

}  // namespace orbwatch::app::daemon
