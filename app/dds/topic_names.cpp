#include "app/dds/topic_names.h"

#include <algorithm>

namespace orbwatch::app {

namespace {

constexpr std::string_view kRosTopic = "rt/";
constexpr std::string_view kImage = "/image_raw";
constexpr std::string_view kCompressed = "/compressed";
constexpr std::string_view kProcessState = "/process_state";

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

std::string compressed_topic(std::string_view raw) { return std::string(raw).append(kCompressed); }

std::string process_state_topic(std::string_view prefix) {
  return std::string(kRosTopic).append(prefix).append(kProcessState);
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

bool is_compressed_topic(std::string_view topic) { return topic.ends_with(kCompressed); }

bool is_process_state_topic(std::string_view topic) { return topic.ends_with(kProcessState); }

std::string full_topic(std::string_view topic) {
  if (topic.starts_with('/')) topic.remove_prefix(1);
  if (topic.starts_with(kRosTopic)) return std::string(topic);
  return std::string(kRosTopic).append(topic);
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

std::string file_stem(std::string_view topic, std::string_view prefix) {
  if (topic.starts_with(kRosTopic)) topic.remove_prefix(kRosTopic.size());
  if (topic.starts_with(prefix) && topic.substr(prefix.size()).starts_with('/')) {
    topic.remove_prefix(prefix.size() + 1);
  }
  const bool compressed = is_compressed_topic(topic);
  if (compressed) topic.remove_suffix(kCompressed.size());
  if (topic.ends_with(kImage)) topic.remove_suffix(kImage.size());
  std::string stem(topic.empty() ? "image" : topic);
  if (compressed) stem += "-compressed";
  for (char& c : stem) {
    if (c == '/')
      c = '-';
    else if (!is_letter(c) && !is_digit(c) && c != '-' && c != '.')
      c = '_';
  }
  if (stem.front() == '.') stem.front() = '_';
  return stem;
}

}  // namespace orbwatch::app
