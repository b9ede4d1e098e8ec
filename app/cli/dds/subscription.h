// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "app/cli/dds/topic_text.h"
#include "app/ports/dds/participant/entity.h"
#include "app/ports/dds/participant/time_message.h"
#include "app/ports/dds/topics/topic_reader.h"

namespace orbwatch::app::cli {

/// True if the topic of that name carries JPEG pictures.
bool is_compressed_topic(std::string_view topic);
/// True if the topic of that name carries the process state.
bool is_process_state_topic(std::string_view topic);

/// Names of the types that can be read, as text.
std::string readable_types();

/// DDS name of a topic given with or without "rt/" or a leading "/".
std::string full_topic(std::string_view topic);

/// File name, without extension, of the newest image of `topic`: "front" for
/// rt/<prefix>/front/image_raw, "front-radiometric" for rt/<prefix>/front/radiometric/image_raw,
/// "front-compressed" for rt/<prefix>/front/image_raw/compressed. For any topic, it contains only
/// letters, digits, '_', '-' and '.' and never starts with a dot.
std::string file_stem(std::string_view topic, std::string_view prefix);

/// Reception of one topic.
struct TopicReport {
  std::string topic;
  std::uint64_t received = 0;  ///< valid samples
  /// Samples that DDS reports as lost (SAMPLE_LOST). Samples that a KEEP_LAST writer replaced
  /// before their delivery are not included; they show as gaps.
  std::uint64_t lost = 0;
  double longest_gap_ms = 0;    ///< longest time between two samples, by the writer's clock
  std::uint64_t refused = 0;    ///< invalid samples
  std::string refusal;          ///< reason of the newest refusal
  std::filesystem::path saved;  ///< the picture file; empty when none was written
};

/// Subscription to one topic. Thread-bound.
class Subscription {
 public:
  /// Makes a subscription for process states, JPEG pictures or images, by the name of `topic`.
  /// `keep`: save() needs the newest picture.
  static std::unique_ptr<Subscription> make(const std::string& topic, bool keep);

  Subscription(const Subscription&) = delete;
  Subscription& operator=(const Subscription&) = delete;
  virtual ~Subscription() = default;

  Result<> open(const dds::Entity& participant) { return reader_.open(participant, qos_); }
  const dds::TopicReader& reader() const { return reader_; }

  /// Takes the samples that DDS holds now, without waiting, and calls `each`, unless it is empty,
  /// with every valid one. Error: DDS refuses.
  Result<> take(const std::function<void(const TopicSample&)>& each);

  /// Figures of the time since the last call, `seconds` long.
  TopicFigures figures(double seconds);

  /// Saves the newest picture as PNG into `folder`; does nothing for other content, or without a
  /// picture.
  Result<> save(const std::filesystem::path& folder, const std::string& prefix);

  const TopicReport& report() const { return report_; }

 protected:
  /// Content of a valid sample.
  struct Content {
    dds::TimeMessage stamp;  ///< exposure start
    std::string text;        ///< short description
  };

  Subscription(const dds_topic_descriptor_t& type, std::string topic, dds::Qos qos);

  /// Checks a sample, which is valid during the call only, and copies the data needed later.
  virtual Result<Content> accept(const void* sample) = 0;
  virtual bool has_picture() const { return false; }
  virtual Result<> write_png(const std::filesystem::path& /*path*/) const { return {}; }

 private:
  /// Counts and returns the sample.
  TopicSample count(const Content& content, dds_time_t written);

  /// Sums over the samples since the last figures().
  struct Interval {
    std::uint64_t samples = 0;
    double since_write_ms = 0;
    double since_exposure_ms = 0;
    double longest_gap_ms = 0;
  };

  dds::Qos qos_;
  dds::TopicReader reader_;
  TopicReport report_;
  Interval interval_;
  std::string newest_;  ///< content of the newest sample
  std::optional<dds_time_t> last_written_;
};

}  // namespace orbwatch::app::cli
