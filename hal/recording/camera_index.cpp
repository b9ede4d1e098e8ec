// SPDX-License-Identifier: Apache-2.0
#include "hal/recording/camera_index.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "hal/mcap/cdr.h"
#include "hal/recording/messages.h"
#include "hal/recording/recorded_part.h"

namespace orbwatch::hal::recording {
namespace {

/// Gathers the index from the messages of a recording in their order.
class Indexer {
 public:
  Indexer(const mcap::Summary& summary, CameraChannels channels) {
    index_.channels = std::move(channels);
    for (const auto& [id, channel] : summary.channels) {
      if (has_pictures(summary, channel)) of_pictures_.insert(id);
      if (type_of(summary, channel) == SetNumbers::kType) of_states_.insert(id);
    }
  }

  /// `number`: of the message in the chunk.
  Result<> add(const mcap::Message& message, std::size_t chunk, std::size_t number) {
    const std::uint16_t channel = message.head.channel_id;
    if (channel == index_.channels.info) return take_place(message);
    if (of_states_.contains(channel)) take_trigger(message);
    if (!of_pictures_.contains(channel)) return {};
    if (auto taken = take_time(message.head.log_time); !taken) return taken;
    if (channel != index_.channels.pictures.id) return {};
    return take_picture(message, chunk, number).map_error([&](const Error& error) {
      return Error{index_.channels.pictures.topic + ", picture " +
                   std::to_string(index_.exposures.size()) + ": " + error.message};
    });
  }

  Result<CameraIndex> result() {
    if (index_.exposures.empty()) return fail(index_.channels.pictures.topic + ": no picture");
    for (RecordedExposure& exposure : index_.exposures) {
      const auto found = triggers_.find(exposure.set_time);
      if (found != triggers_.end()) exposure.trigger = found->second;
    }
    const RecordedTime& time = index_.time;
    if (sets_ > 1) {
      index_.time.period = std::chrono::nanoseconds(time.end - time.begin) / (sets_ - 1);
    }
    if (!triggers_.empty()) {
      const auto number = [](const auto& entry) { return entry.second; };
      const auto [first, last] = std::ranges::minmax_element(triggers_, {}, number);
      index_.triggers = last->second - first->second + 1;
    }
    return std::move(index_);
  }

 private:
  Result<> take_place(const mcap::Message& message) {
    CameraInfo info;
    if (!mcap::decode_cdr(message.data, info)) return fail("camera_info: damaged");
    auto place = place_of(info);
    if (!place) return tl::unexpected(place.error());
    place_ = *place;
    return {};
  }

  void take_trigger(const mcap::Message& message) {
    SetNumbers numbers;
    if (!mcap::decode_cdr(message.data, numbers) || numbers.trigger == 0) return;
    if (triggers_.size() < kMostPictures) triggers_[message.head.log_time] = numbers.trigger;
  }

  /// Time of a picture of any camera.
  Result<> take_time(std::uint64_t stamp) {
    RecordedTime& time = index_.time;
    if (sets_ > 0 && stamp < time.end) {
      return fail("picture at " + std::to_string(stamp) + " ns behind one at " +
                  std::to_string(time.end) + " ns; frame sets must not go backwards");
    }
    if (sets_ == 0) time.begin = stamp;
    if (sets_ == 0 || stamp > time.end) ++sets_;
    time.end = stamp;
    constexpr auto kLongest = std::chrono::nanoseconds(kLongestRecording).count();
    if (time.end - time.begin <= std::uint64_t{kLongest}) return {};
    return fail("pictures of " + std::to_string((time.end - time.begin) / 1'000'000'000) +
                " s; at most 240 hours are replayed");
  }

  Result<> take_picture(const mcap::Message& message, std::size_t chunk, std::size_t number) {
    const bool is_first = index_.exposures.empty();
    if (index_.exposures.size() == kMostPictures) {
      return fail("at most " + std::to_string(kMostPictures) + " pictures are replayed");
    }
    if (is_first) {
      auto format = first_format(message, index_.channels);
      if (!format) return tl::unexpected(format.error());
      index_.format = *format;
    }
    auto part = part_in(message, index_.channels, index_.format.format);
    if (!part) return tl::unexpected(part.error());
    const auto start = stamp_of(part->header);
    if (!start) return fail("its stamp is before 1970, or has a second of nanoseconds");
    if (!is_first && *start <= index_.exposures.back().start) {
      return fail("its stamp must be later than that of the picture before");
    }
    constexpr auto kLongest = std::uint64_t{std::chrono::nanoseconds(kLongestAge).count()};
    const std::uint64_t set_time = message.head.log_time;
    if (std::max(*start, set_time) - std::min(*start, set_time) > kLongest) {
      return fail("its stamp must be within 10 s of its log_time");
    }
    const PicturePlace place =
        place_.value_or(PicturePlace{part->width, part->height, {0, 0, part->width, part->height}});
    if (is_first) {
      index_.format.width = place.width;
      index_.format.height = place.height;
    }
    if (auto fits = check_fit(*part, place); !fits) return fits;
    index_.exposures.push_back(
        {set_time, *start, message.head.sequence, std::nullopt, place.region, chunk, number});
    return {};
  }

  Result<> check_fit(const RecordedPart& part, const PicturePlace& place) const {
    const StreamFormat& whole = index_.format;
    if (place.width != whole.width || place.height != whole.height) {
      return fail("camera_info has another size than that of the first picture");
    }
    return hal::recording::check_fit(part.format, part.width, part.height, place, whole.format);
  }

  CameraIndex index_;
  std::set<std::uint16_t> of_pictures_, of_states_;  ///< channels
  std::optional<PicturePlace> place_;                ///< newest
  std::size_t sets_ = 0;
  std::map<std::uint64_t, std::uint64_t> triggers_;  ///< by the stamp of their frame set
};

}  // namespace

Result<CameraIndex> index_camera(mcap::Reader& reader, std::string_view camera) {
  auto channels = channels_of(reader.summary(), camera);
  if (!channels) return tl::unexpected(channels.error());
  Indexer indexer(reader.summary(), std::move(*channels));
  for (std::size_t chunk = 0; chunk < reader.summary().chunks.size(); ++chunk) {
    if (const auto loaded = reader.load_chunk(chunk); !loaded) return fail(loaded.error().message);
    for (std::size_t number = 0; const auto message = reader.next(); ++number) {
      if (auto added = indexer.add(*message, chunk, number); !added) {
        return tl::unexpected(added.error());
      }
    }
  }
  return indexer.result();
}

}  // namespace orbwatch::hal::recording
