// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "app/ports/recorder/messages.h"
#include "hal/mcap/cdr.h"
#include "hal/mcap/reader.h"

namespace orbwatch::tests {

/// A message of a recording, decoded by the test.
struct ReadMessage {
  std::uint64_t log_time = 0;
  std::uint32_t sequence = 0;
  std::vector<std::byte> bytes;
};

/// All messages of a recording by topic, in the order of their time.
inline std::map<std::string, std::vector<ReadMessage>> read_recording(
    const std::filesystem::path& file) {
  std::map<std::string, std::vector<ReadMessage>> topics;
  auto reader = hal::mcap::Reader::open(file);
  EXPECT_TRUE(reader) << reader.error().message;
  if (!reader) return topics;
  EXPECT_TRUE(reader->is_finished());
  for (std::size_t n = 0; n < reader->summary().chunks.size(); ++n) {
    EXPECT_TRUE(reader->load_chunk(n));
    while (const auto message = reader->next()) {
      topics[reader->summary().channels.at(message->head.channel_id).topic].push_back(
          {message->head.log_time,
           message->head.sequence,
           {message->data.begin(), message->data.end()}});
    }
  }
  for (auto& [topic, messages] : topics) {
    std::ranges::stable_sort(messages, {}, &ReadMessage::log_time);
  }
  return topics;
}

/// Contents of a file.
inline std::string text_in(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Numbers of the frame sets of process states.
inline std::vector<std::uint64_t> frame_sets_of(const std::vector<ReadMessage>& states) {
  std::vector<std::uint64_t> numbers;
  for (const ReadMessage& message : states) {
    app::recorder::ProcessState state;
    EXPECT_TRUE(hal::mcap::decode_cdr(message.bytes, state));
    numbers.push_back(state.frame_set);
  }
  return numbers;
}

}  // namespace orbwatch::tests
