// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace orbwatch::app::cli {

/// One valid sample of a topic.
struct TopicSample {
  std::string topic;
  std::string content;           ///< short description
  double since_exposure_ms = 0;  ///< time from exposure start to its arrival
};

/// Figures of a topic over a period. Means and the gap refer to its samples, 0 without any.
struct TopicFigures {
  std::string topic;
  double seconds = 0;
  std::uint64_t samples = 0;
  double longest_gap_ms = 0;  ///< longest time between two samples, by the writer's clock
  double since_write_ms = 0;
  double since_exposure_ms = 0;
  std::string newest{};       ///< content of the newest sample
  std::uint64_t lost = 0;     ///< total since the start
  std::uint64_t refused = 0;  ///< total since the start
  std::string refusal{};      ///< reason of the newest refusal
};

/// One line of text for people. All reentrant.
std::string topic_line(const TopicSample& sample);
std::string topic_line(const TopicFigures& figures);

/// One JSON object on one line.
std::string topic_json(const TopicSample& sample);
std::string topic_json(const TopicFigures& figures);

}  // namespace orbwatch::app::cli
