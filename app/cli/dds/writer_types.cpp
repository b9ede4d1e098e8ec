// SPDX-License-Identifier: Apache-2.0
#include "app/cli/dds/writer_types.h"

#include <algorithm>

#include "app/model/plain_text.h"

namespace orbwatch::app::cli {
namespace {

/// Limit for the names of foreign types, which are arbitrary.
constexpr std::size_t kLongestType = 200;
/// Limit for the types on one topic; a flood of them is not kept.
constexpr std::size_t kMostTypes = 8;
constexpr std::size_t kMostTopics = 10000;

}  // namespace

std::string type_text(std::string_view type) {
  constexpr std::string_view kRos = "::msg::dds_::";
  std::string text(type);
  const std::size_t place = text.find(kRos);
  if (place != text.npos && text.ends_with('_')) {
    text.pop_back();
    text.replace(place, kRos.size(), "/msg/");
  }
  return plain_text(text, kLongestType);
}

Result<> WriterTypes::open(const dds::Entity& participant) {
  const dds_entity_t handle =
      dds_create_reader(participant.get(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr);
  if (handle < 0) return tl::unexpected(dds::dds_error("reader of discovered writers", handle));
  reader_ = dds::Entity(handle);
  return {};
}

Result<> WriterTypes::update(hal::TimePoint now) {
  const auto note = [&](const void* sample, const dds_sample_info_t&) {
    const auto& writer = *static_cast<const dds_builtintopic_endpoint_t*>(sample);
    if (topics_.size() == kMostTopics && !topics_.contains(writer.topic_name)) return;
    Types& types = topics_[writer.topic_name];
    if (types.size() < kMostTypes) types.emplace(writer.type_name, now);
  };
  for (;;) {
    const auto taken = dds::take_samples(reader_.get(), note);
    if (!taken) return tl::unexpected(taken.error());
    if (*taken == 0) return {};
  }
}

std::string WriterTypes::unreadable(const dds::TopicReader& reader, hal::TimePoint now) const {
  const auto topic = topics_.find(reader.name());
  if (topic == topics_.end() || topic->second.contains(reader.type_name())) return {};
  const auto first =
      std::ranges::min_element(topic->second, {}, [](const auto& type) { return type.second; });
  return now - first->second >= kDiscovery ? first->first : std::string();
}

}  // namespace orbwatch::app::cli
