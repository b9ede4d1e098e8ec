// SPDX-License-Identifier: Apache-2.0
#include "hal/recording/camera_channels.h"

#include <algorithm>
#include <utility>

#include "hal/recording/messages.h"
#include "hal/recording/topics.h"

namespace orbwatch::hal::recording {
namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text.empty() ? "of no camera" : "of " + text;
}

/// Channels of the camera with this type.
std::vector<const mcap::Channel*> channels_of_type(const mcap::Summary& summary,
                                                   std::string_view camera, std::string_view type) {
  std::vector<const mcap::Channel*> channels;
  for (const auto& [id, channel] : summary.channels) {
    if (type_of(summary, channel) == type && camera_of(channel.topic) == camera) {
      channels.push_back(&channel);
    }
  }
  return channels;
}

}  // namespace

std::string_view type_of(const mcap::Summary& summary, const mcap::Channel& channel) {
  const auto schema = summary.schemas.find(channel.schema_id);
  const bool is_cdr = channel.message_encoding == "cdr" && schema != summary.schemas.end();
  return is_cdr ? std::string_view(schema->second.name) : std::string_view();
}

bool has_pictures(const mcap::Summary& summary, const mcap::Channel& channel) {
  const std::string_view type = type_of(summary, channel);
  return (type == Image::kType || type == CompressedImage::kType) && camera_of(channel.topic);
}

std::vector<std::string> cameras_in(const mcap::Summary& summary) {
  std::vector<std::string> cameras;
  for (const auto& [id, channel] : summary.channels) {
    if (!has_pictures(summary, channel)) continue;
    std::string camera(*camera_of(channel.topic));
    if (std::ranges::find(cameras, camera) == cameras.end()) cameras.push_back(std::move(camera));
  }
  return cameras;
}

Result<CameraChannels> channels_of(const mcap::Summary& summary, std::string_view camera) {
  CameraChannels channels;
  auto pictures = channels_of_type(summary, camera, Image::kType);
  if (pictures.empty()) {
    pictures = channels_of_type(summary, camera, CompressedImage::kType);
    channels.is_jpeg = true;
  }
  if (pictures.empty()) {
    return fail("no pictures of camera " + std::string(camera) + "; it has pictures " +
                listed(cameras_in(summary)));
  }
  if (pictures.size() > 1) {
    return fail("pictures of camera " + std::string(camera) + " in two channels, " +
                pictures[0]->topic + " and " + pictures[1]->topic + "; there must be one");
  }
  channels.pictures = *pictures.front();
  const auto infos = channels_of_type(summary, camera, CameraInfo::kType);
  if (infos.size() > 1) return fail("camera_info of camera " + std::string(camera) + " twice");
  if (!infos.empty()) channels.info = infos.front()->id;
  return channels;
}

}  // namespace orbwatch::hal::recording
