#pragma once

#include <cstdint>
#include <string>

namespace orbwatch::app {

/// One valid sample of a topic.
struct TopicSample {
  std::string topic;
  std::string content;           ///< in a few words
  double since_exposure_ms = 0;  ///< from exposure start to its arrival
};

/// What a topic brought in some time. Means and the gap are of its samples, 0 without any.
struct TopicFigures {
  std::string topic;
  double seconds = 0;
  std::uint64_t samples = 0;
  double longest_gap_ms = 0;  ///< between two samples, by the writer's clock
  double since_write_ms = 0;
  double since_exposure_ms = 0;
  std::string newest{};       ///< content
  std::uint64_t lost = 0;     ///< since the beginning
  std::uint64_t refused = 0;  ///< since the beginning
  std::string refusal{};      ///< of the newest one
};

/// A line for people. All reentrant.
std::string topic_line(const TopicSample& sample);
std::string topic_line(const TopicFigures& figures);

/// An object on one line.
std::string topic_json(const TopicSample& sample);
std::string topic_json(const TopicFigures& figures);

}  // namespace orbwatch::app
