// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/recorded_states.h"

#include <algorithm>

#include "hal/mcap/cdr.h"
#include "hal/recording/camera_channels.h"
#include "hal/recording/messages.h"

namespace orbwatch::app::recorder {

Result<RecordedStates> RecordedStates::open(const std::filesystem::path& file) {
  auto reader = hal::mcap::Reader::open(file);
  if (!reader) return fail(reader.error().message);
  return RecordedStates(file, std::move(*reader));
}

Result<std::optional<RecordedState>> RecordedStates::next() {
  while (true) {
    const auto message = reader_.next();
    if (!message) {
      if (next_chunk_ == reader_.summary().chunks.size()) return std::nullopt;
      if (const auto loaded = reader_.load_chunk(next_chunk_++); !loaded) {
        return fail(loaded.error().message);
      }
      continue;
    }
    const auto& channel = reader_.summary().channels.at(message->head.channel_id);
    if (hal::recording::type_of(reader_.summary(), channel) != hal::recording::SetNumbers::kType) {
      continue;
    }
    return state_in(*message, channel.topic);
  }
}

Result<RecordedState> RecordedStates::state_in(const hal::mcap::Message& message,
                                               const std::string& topic) {
  RecordedState recorded;
  recorded.utc = message.head.log_time;
  recorded.computed = std::max(recorded.utc, message.head.publish_time);
  if (!hal::mcap::decode_cdr(message.data, recorded.state)) {
    return fail(file_.string() + ": " + topic + ", state " + std::to_string(count_) + ": damaged");
  }
  ++count_;
  return recorded;
}

}  // namespace orbwatch::app::recorder
