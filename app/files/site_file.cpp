#include "app/files/site_file.h"

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "app/pictures/picture_file.h"
#include "hal/regular_file.h"

namespace orbwatch::app {
namespace {

std::filesystem::path kept_in(const std::filesystem::path& folder) {
  return folder / "last-good.json";
}

}  // namespace

std::filesystem::path site_file(const std::filesystem::path& given) {
  if (!given.empty()) return given;
  const char* const named = std::getenv("ORBWATCH_CONFIG");
  return named != nullptr && *named != '\0' ? named : "/etc/orbwatch/site.toml";
}

Result<> keep_last_good(const std::filesystem::path& folder, const Resolved& site) {
  nlohmann::json files = nlohmann::json::object();
  for (const auto& [path, text] : site.texts) files[path.string()] = text;
  std::error_code none;  // write_file() says what is wrong with the folder
  std::filesystem::create_directories(folder, none);
  // Comments may have any bytes.
  constexpr auto kReplace = nlohmann::json::error_handler_t::replace;
  return write_file(kept_in(folder), files.dump(1, ' ', false, kReplace) + "\n");
}

Result<Resolved> resolve_last_good(const std::filesystem::path& folder,
                                   const std::filesystem::path& file) {
  const auto kept = kept_in(folder);
  std::error_code none;  // read_regular_file() says what is wrong
  if (!std::filesystem::exists(kept, none) && !none) {
    return fail(kept.string() + ": no configuration ran here before");
  }
  const auto json = hal::read_regular_file(kept, kMostTexts);
  if (!json) return tl::unexpected(json.error());
  const auto files = nlohmann::json::parse(*json, nullptr, false);
  if (!files.is_object()) return fail(kept.string() + ": is damaged");
  FileTexts texts;
  for (const auto& [path, text] : files.items()) {
    if (!text.is_string()) return fail(kept.string() + ": is damaged");
    texts[path] = text.get<std::string>();
  }
  if (!texts.contains(file)) {
    return fail(kept.string() + ": what ran here before was not " + file.string());
  }
  return resolve(file, texts);
}

}  // namespace orbwatch::app
