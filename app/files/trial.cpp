#include "app/files/trial.h"

#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "app/files/text_file.h"
#include "hal/atomic_file.h"
#include "hal/regular_file.h"

namespace orbwatch::app {
namespace {

namespace fs = std::filesystem;

fs::path requested_in(const fs::path& folder) { return folder / "trial.json"; }
fs::path running_in(const fs::path& folder) { return folder / "trial-running.json"; }

Result<std::optional<Trial>> read(const fs::path& file) {
  std::error_code none;  // read_regular_file() says what is wrong
  if (!fs::exists(file, none) && !none) return std::nullopt;
  const auto text = hal::read_regular_file(file, kMostTexts);
  if (!text) return tl::unexpected(text.error());
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  try {
    Trial trial{json.at("site").get<std::string>(), {}, json.at("seconds").get<int>()};
    for (const auto& [path, kept] : json.at("files").items()) {
      trial.texts[path] = kept.get<std::string>();
    }
    return trial;
  } catch (const nlohmann::json::exception&) {
    return fail(file.string() + ": is damaged");
  }
}

}  // namespace

Result<> request_trial(const fs::path& folder, const Trial& trial) {
  nlohmann::json files = nlohmann::json::object();
  for (const auto& [path, text] : trial.texts) files[path.string()] = text;
  const nlohmann::json json{
      {"site", trial.site.string()}, {"seconds", trial.seconds}, {"files", files}};
  // Comments may have any bytes.
  constexpr auto kReplace = nlohmann::json::error_handler_t::replace;
  return hal::write_file(requested_in(folder), json.dump(1, ' ', false, kReplace) + "\n");
}

bool is_trial_requested(const fs::path& folder) {
  std::error_code none;
  return fs::exists(requested_in(folder), none);
}

Result<std::optional<Trial>> take_trial(const fs::path& folder) {
  std::error_code error;
  fs::rename(requested_in(folder), running_in(folder), error);
  if (error == std::errc::no_such_file_or_directory) return std::nullopt;
  if (error) return fail(requested_in(folder).string() + ": " + error.message());
  return running_trial(folder);
}

Result<std::optional<Trial>> running_trial(const fs::path& folder) {
  return read(running_in(folder));
}

bool end_trial(const fs::path& folder) {
  std::error_code none;
  return fs::remove(running_in(folder), none);
}

}  // namespace orbwatch::app
