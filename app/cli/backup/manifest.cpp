// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/manifest.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace orbwatch::app::cli::backup {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormatKey = "orbwatch_backup";

/// Modes are octal text, as in ls and chmod.
std::string mode_text(mode_t mode) {
  std::string text;
  for (int shift = 6; shift >= 0; shift -= 3) {
    text += static_cast<char>('0' + (mode >> shift & 7U));
  }
  return text;
}

/// Nullopt: not three octal digits.
std::optional<mode_t> to_mode(const std::string& text) {
  if (text.size() != 3 || text.find_first_not_of("01234567") != text.npos) return std::nullopt;
  mode_t mode = 0;
  for (const char digit : text) mode = mode * 8 + static_cast<mode_t>(digit - '0');
  return mode;
}

/// Throws Json::exception. Nullopt: a value that is not allowed.
std::optional<Manifest> read(const Json& json) {
  Manifest manifest;
  manifest.version = json.at("version").get<std::string>();
  manifest.made = json.at("made").get<std::string>();
  manifest.host = json.at("host").get<std::string>();
  manifest.site = json.at("site").get<std::string>();
  const Secrets* secrets = find_word(kSecretsWords, json.at("secrets").get<std::string>());
  if (secrets == nullptr) return std::nullopt;
  manifest.secrets = *secrets;
  for (const Json& file : json.at("files")) {
    const auto mode = to_mode(file.at("mode").get<std::string>());
    if (!mode) return std::nullopt;
    manifest.files.push_back({file.at("name").get<std::string>(),
                              file.at("sha256").get<std::string>(),
                              file.at("size").get<std::size_t>(), *mode});
  }
  manifest.secret_files = json.at("secret_files").get<std::vector<std::string>>();
  manifest.left_out = json.at("left_out").get<std::vector<std::string>>();
  for (const Json& event : json.value("events", Json::array())) {
    manifest.events.push_back(
        {event.at("name").get<std::string>(), event.at("bytes").get<std::uint64_t>()});
  }
  return manifest;
}

}  // namespace

std::string manifest_text(const Manifest& manifest) {
  Json files = Json::array();
  for (const auto& [name, sha256, size, mode] : manifest.files) {
    files.push_back(
        {{"name", name}, {"sha256", sha256}, {"size", size}, {"mode", mode_text(mode)}});
  }
  Json json{{kFormatKey, manifest.events.empty() ? 1 : kFormat},
            {"version", manifest.version},
            {"made", manifest.made},
            {"host", manifest.host},
            {"site", manifest.site},
            {"secrets", std::string(word_for(kSecretsWords, manifest.secrets))},
            {"files", std::move(files)},
            {"secret_files", manifest.secret_files},
            {"left_out", manifest.left_out}};
  for (const auto& [name, bytes] : manifest.events) {
    json["events"].push_back({{"name", name}, {"bytes", bytes}});
  }
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<Manifest> parse_manifest(std::string_view text) {
  try {
    const Json json = Json::parse(text);
    const int format = json.at(kFormatKey).get<int>();
    if (format > kFormat) {
      return fail("is a backup of a newer orbwatch, of format " + std::to_string(format) +
                  "; this one reads format " + std::to_string(kFormat));
    }
    auto manifest = format < 1 ? std::nullopt : read(json);
    if (manifest) return std::move(*manifest);
  } catch (const Json::exception&) {  // the same as a value that is not allowed
  }
  return fail("is damaged: its manifest is not right");
}

}  // namespace orbwatch::app::cli::backup
