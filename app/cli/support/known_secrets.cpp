// SPDX-License-Identifier: Apache-2.0
#include "app/cli/support/known_secrets.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "app/cli/support/redaction.h"
#include "hal/regular_file.h"

namespace orbwatch::app::cli::support {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Shorter lines of a key are its last one, which may be found elsewhere by chance.
constexpr std::size_t kShortestKeyLine = 16;

/// Calls `use` with each line, without its end.
template <class Use>
void for_each_line(std::string_view text, const Use& use) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    use(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

void find_in_key(std::string_view text, std::vector<std::string>& values) {
  bool is_key = false;
  for_each_line(text, [&](std::string_view line) {
    const bool is_title = line.find("PRIVATE KEY-----") != line.npos;
    if (is_title) is_key = line.find("-----BEGIN ") != line.npos;
    if (is_key && !is_title && line.size() >= kShortestKeyLine) values.emplace_back(line);
  });
}

bool is_secret_member(const std::string& name) { return name == "hash" || is_secret_name(name); }

void find_in_json(const Json& value, const std::string& name, int depth,
                  std::vector<std::string>& values) {
  if (value.is_string() && is_secret_member(name)) values.push_back(value.get<std::string>());
  if (!value.is_structured() || depth == 0) return;
  for (const auto& [member, inner] : value.items()) {
    // A list's entries have the name of the list.
    find_in_json(inner, value.is_object() ? member : name, depth - 1, values);
  }
}

void find_in_json(std::string_view text, std::vector<std::string>& values) {
  constexpr int kDeepest = 64;
  find_in_json(Json::parse(text, nullptr, false), "", kDeepest, values);
}

void find_in_file(const fs::path& file, KnownSecrets& secrets) {
  const auto text = hal::read_regular_file(file);
  if (!text) {
    secrets.unread.push_back(text.error().message);
    return;
  }
  find_in_key(*text, secrets.values);
  if (file.filename() == "first-code") {
    for_each_line(*text, [&](std::string_view line) { secrets.values.emplace_back(line); });
  }
  if (file.extension() == ".json") return find_in_json(*text, secrets.values);
  if (file.extension() != ".jsonl") return;
  for_each_line(*text, [&](std::string_view line) { find_in_json(line, secrets.values); });
}

/// Recordings and pictures are larger than files with secrets.
constexpr std::uintmax_t kLargest = 1 << 20;
constexpr int kMostFiles = 5000;

}  // namespace

void find_secrets(const fs::path& place, KnownSecrets& secrets) {
  std::error_code error;
  if (fs::is_regular_file(place, error)) return find_in_file(place, secrets);
  if (!fs::exists(place, error) && !error) return;
  int files = 0;
  for (fs::recursive_directory_iterator it(place, error), end; !error && it != end;
       it.increment(error)) {
    std::error_code vanished;  // a removed file has no secret any more
    if (!it->is_regular_file(vanished) || it->file_size(vanished) > kLargest) continue;
    if (++files > kMostFiles) {
      secrets.unread.push_back(place.string() + ": has too many files to search all of them");
      return;
    }
    find_in_file(it->path(), secrets);
  }
  if (error) secrets.unread.push_back(place.string() + ": cannot be read: " + error.message());
}

void find_secrets_of_environment(std::string_view environment, KnownSecrets& secrets) {
  while (!environment.empty()) {
    const std::size_t end = std::min(environment.find('\0'), environment.size());
    const std::string_view entry = environment.substr(0, end);
    const std::size_t equals = entry.find('=');
    if (equals != entry.npos && is_secret_name(entry.substr(0, equals))) {
      secrets.values.emplace_back(entry.substr(equals + 1));
    }
    environment.remove_prefix(std::min(end + 1, environment.size()));
  }
}

}  // namespace orbwatch::app::cli::support
