// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hal/mcap/cdr.h"
#include "hal/recording/image.h"
#include "tests/app/ports/recorder/events/read_event.h"
#include "tests/app/ports/recorder/events/recorded_machine.h"

/// Contents of a RecordedMachine's events.
namespace orbwatch::tests {

inline constexpr const char* kThermal = "/orbwatch/thermal/image_raw";
inline constexpr const char* kColour = "/orbwatch/colour/image_raw/compressed";
inline constexpr const char* kStates = "/orbwatch/process_state";

/// Numbers of the frames.
inline std::vector<std::uint64_t> sequences_of(const std::vector<ReadMessage>& messages) {
  std::vector<std::uint64_t> numbers;
  for (const ReadMessage& message : messages) numbers.push_back(message.sequence);
  return numbers;
}

/// Checks pixels, stamps and place of each thermal picture.
inline void expect_painted(std::map<std::string, std::vector<ReadMessage>>& topics) {
  const auto& pictures = topics[kThermal];
  const auto& places = topics["/orbwatch/thermal/camera_info"];
  ASSERT_EQ(places.size(), pictures.size());
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    hal::recording::Image image;
    hal::recording::CameraInfo info;
    ASSERT_TRUE(hal::mcap::decode_cdr(pictures[i].bytes, image));
    ASSERT_TRUE(hal::mcap::decode_cdr(places[i].bytes, info));
    EXPECT_EQ(image.encoding, "mono16");
    EXPECT_EQ(image.header, info.header);
    EXPECT_EQ(hal::recording::stamp_of(image.header), pictures[i].log_time);
    const auto place = hal::recording::place_of(info);
    ASSERT_TRUE(place);
    ASSERT_EQ(place->region, RecordedMachine::kBall);
    EXPECT_EQ(place->width, RecordedMachine::kWidth);
    const auto picture = hal::recording::picture_of(image);
    ASSERT_TRUE(picture) << picture.error().message;
    const auto samples = picture->samples<std::uint16_t>();
    for (int y = 0; y < samples.height; ++y) {
      for (int x = 0; x < samples.width; ++x) {
        ASSERT_EQ(samples.row(y)[x],
                  painted(pictures[i].sequence, 0, x + place->region.x, y + place->region.y));
      }
    }
  }
}

}  // namespace orbwatch::tests
