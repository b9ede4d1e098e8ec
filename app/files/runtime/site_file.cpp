// SPDX-License-Identifier: Apache-2.0
#include "app/files/runtime/site_file.h"

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "hal/atomic_file.h"
#include "hal/regular_file.h"

namespace orbwatch::app::files {
namespace {

std::filesystem::path kept_in(const std::filesystem::path& folder) {
  return folder / "last-good.json";
}

/// Kept in a file of its own: alignments accepted later also apply to a configuration that ran
/// before.
std::filesystem::path calibration_kept_in(const std::filesystem::path& folder) {
  return folder / "last-good-calibration.json";
}

Result<> keep(const std::filesystem::path& file, const FileTexts& texts) {
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [path, text] : texts) json[path.string()] = text;
  // Comments may contain any bytes.
  constexpr auto kReplace = nlohmann::json::error_handler_t::replace;
  return hal::write_file(file, json.dump(1, ' ', false, kReplace) + "\n", hal::FileAccess::Owner);
}

Result<FileTexts> read_kept(const std::filesystem::path& file, const std::string& if_absent) {
  std::error_code none;  // read_regular_file() reports the error
  if (!std::filesystem::exists(file, none) && !none) return fail(file.string() + ": " + if_absent);
  const auto text = hal::read_regular_file(file, kMostTexts);
  if (!text) return tl::unexpected(text.error());
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  if (!json.is_object()) return fail(file.string() + ": is damaged");
  FileTexts texts;
  for (const auto& [path, kept] : json.items()) {
    if (!kept.is_string()) return fail(file.string() + ": is damaged");
    texts[path] = kept.get<std::string>();
  }
  return texts;
}

}  // namespace

std::filesystem::path site_file(const std::filesystem::path& given) {
  if (!given.empty()) return given;
  const char* const named = std::getenv("ORBWATCH_CONFIG");
  return named != nullptr && *named != '\0' ? named : kDefaultSiteFile;
}

Result<> keep_last_good(const std::filesystem::path& folder, const Resolved& site) {
  std::error_code none;  // write_file() reports an error of the folder
  std::filesystem::create_directories(folder, none);
  return keep(calibration_kept_in(folder), site.calibration).and_then([&] {
    return keep(kept_in(folder), site.texts);
  });
}

Result<Resolved> resolve_last_good(const std::filesystem::path& folder,
                                   const std::filesystem::path& file) {
  const auto kept = kept_in(folder);
  auto texts = read_kept(kept, "no configuration ran here before");
  if (!texts) return tl::unexpected(texts.error());
  if (!texts->contains(file)) {
    return fail(kept.string() + ": what ran here before was not " + file.string());
  }
  auto with_accepted = resolve(file, *texts);
  if (with_accepted) return with_accepted;
  auto calibration = read_kept(calibration_kept_in(folder), "no alignments were kept");
  if (!calibration) {
    return fail(with_accepted.error().message + "; " + calibration.error().message);
  }
  texts->merge(*calibration);
  return resolve(file, *texts);
}

}  // namespace orbwatch::app::files
