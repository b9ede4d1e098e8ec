// SPDX-License-Identifier: Apache-2.0
#include "app/cli/dds/topic_text.h"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/model/status/json.h"

namespace orbwatch::app::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Text from foreign writers may not be UTF-8.
std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Mean; null without a sample.
Json mean(double value, const TopicFigures& figures) {
  return figures.samples > 0 ? to_json(value) : Json();
}

}  // namespace

std::string topic_line(const TopicSample& sample) { return sample.topic + ": " + sample.content; }

std::string topic_line(const TopicFigures& figures) {
  std::string text = figures.topic + ": ";
  if (figures.samples == 0) {
    text += "nothing";
  } else {
    std::array<char, 160> numbers{};
    std::snprintf(numbers.data(), numbers.size(),
                  "%.1f/s, longest gap %.0f ms, latency %.1f ms from writing, %.1f ms from "
                  "exposure, ",
                  static_cast<double>(figures.samples) / figures.seconds, figures.longest_gap_ms,
                  figures.since_write_ms, figures.since_exposure_ms);
    text += numbers.data() + figures.newest;
  }
  text += ", lost " + std::to_string(figures.lost);
  if (figures.refused > 0) {
    text += ", refused " + std::to_string(figures.refused) + " (" + figures.refusal + ")";
  }
  return text;
}

std::string topic_json(const TopicSample& sample) {
  return line_of({{"topic", sample.topic},
                  {"content", sample.content},
                  {"since_exposure_ms", to_json(sample.since_exposure_ms)}});
}

std::string topic_json(const TopicFigures& figures) {
  return line_of({{"topic", figures.topic},
                  {"seconds", to_json(figures.seconds)},
                  {"samples", figures.samples},
                  {"rate", to_json(static_cast<double>(figures.samples) / figures.seconds)},
                  {"longest_gap_ms", mean(figures.longest_gap_ms, figures)},
                  {"since_write_ms", mean(figures.since_write_ms, figures)},
                  {"since_exposure_ms", mean(figures.since_exposure_ms, figures)},
                  {"newest", figures.samples > 0 ? Json(figures.newest) : Json()},
                  {"lost", figures.lost},
                  {"refused", figures.refused},
                  {"refusal", figures.refusal}});
}

}  // namespace orbwatch::app::cli
