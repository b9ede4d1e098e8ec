#include "app/ports/dds/topics/topic_names.h"

#include <algorithm>

namespace orbwatch::app {

namespace {

constexpr std::string_view kRosTopic = "rt/";
constexpr std::string_view kImage = "/image_raw";

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

std::string image_topic(std::string_view prefix, std::string_view view) {
  return std::string(kRosTopic).append(prefix).append("/").append(view).append(kImage);
}

std::string radiometric_topic(std::string_view prefix, std::string_view view) {
  return image_topic(prefix, std::string(view) + "/radiometric");
}

std::string camera_info_topic(std::string_view prefix, std::string_view view) {
  return std::string(kRosTopic).append(prefix).append("/").append(view).append("/camera_info");
}

std::string ball_topic(std::string_view prefix, std::string_view camera) {
  return image_topic(prefix, std::string(camera) + "/ball");
}

std::string compressed_topic(std::string_view raw) {
  return std::string(raw).append("/compressed");
}

std::string process_state_topic(std::string_view prefix) {
  return std::string(kRosTopic).append(prefix).append("/process_state");
}

std::string event_topic(std::string_view prefix) {
  return std::string(kRosTopic).append(prefix).append("/event");
}

std::string command_topic(std::string_view prefix) {
  return std::string(kRosTopic).append(prefix).append("/command");
}

std::string command_result_topic(std::string_view prefix) {
  return std::string(kRosTopic).append(prefix).append("/command_result");
}

Result<> check_topic_part(std::string_view part, std::string_view what) {
  const bool valid = !part.empty() && !is_digit(part.front()) &&
                     std::ranges::all_of(part, [](char c) { return is_letter(c) || is_digit(c); });
  if (valid) return {};
  return fail("DDS: " + std::string(what) + " \"" + std::string(part) +
              "\" is no ROS 2 name: letters, digits and '_', no digit first");
}

Result<> check_topic_path(std::string_view path, std::string_view what) {
  const std::size_t slash = path.find('/');
  const auto checked = check_topic_part(path.substr(0, slash), what);
  if (!checked || slash == std::string_view::npos) return checked;
  return check_topic_path(path.substr(slash + 1), what);
}

}  // namespace orbwatch::app
