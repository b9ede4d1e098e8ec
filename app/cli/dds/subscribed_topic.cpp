#include "app/cli/dds/subscribed_topic.h"

#include <algorithm>

namespace orbwatch::app {
namespace {

constexpr std::string_view kRosTopic = "rt/";
constexpr std::string_view kImage = "/image_raw";
constexpr std::string_view kCompressed = "/compressed";
constexpr std::string_view kProcessState = "/process_state";

bool is_file_name_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == '.';
}

}  // namespace

bool is_compressed_topic(std::string_view topic) { return topic.ends_with(kCompressed); }

bool is_process_state_topic(std::string_view topic) { return topic.ends_with(kProcessState); }

std::string full_topic(std::string_view topic) {
  if (topic.starts_with('/')) topic.remove_prefix(1);
  if (topic.starts_with(kRosTopic)) return std::string(topic);
  return std::string(kRosTopic).append(topic);
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
  std::ranges::replace(stem, '/', '-');
  std::ranges::replace_if(
      stem, [](char c) { return !is_file_name_letter(c); }, '_');
  if (stem.front() == '.') stem.front() = '_';
  return stem;
}

}  // namespace orbwatch::app
