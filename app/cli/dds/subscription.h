#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/dds/received_image.h"
#include "app/ports/dds/participant/entity.h"
#include "app/ports/dds/participant/time_message.h"
#include "app/ports/dds/topics/topic_reader.h"
#include "hal/jpeg/jpeg_decoder.h"

namespace orbwatch::app {

/// What was received on one topic.
struct TopicReport {
  std::string topic;
  std::uint64_t received = 0;  ///< valid samples
  /// Samples that DDS reports as lost (SAMPLE_LOST). Samples that a KEEP_LAST writer replaced
  /// before their delivery are not among them; they show as gaps.
  std::uint64_t lost = 0;
  double longest_gap_ms = 0;    ///< between two samples, by the writer's clock
  std::uint64_t refused = 0;    ///< invalid samples
  std::string refusal;          ///< why the newest refused one was
  std::filesystem::path saved;  ///< the picture file; empty when none was written
};

/// One topic that is read. Thread-bound.
class Subscription {
 public:
  Subscription(const Subscription&) = delete;
  Subscription& operator=(const Subscription&) = delete;
  virtual ~Subscription() = default;

  Result<> open(const Entity& participant) { return reader_.open(participant, qos_); }
  const TopicReader& reader() const { return reader_; }

  /// Takes the samples that DDS holds now, without waiting; writes a line on each sample to `each`
  /// unless that is null. Error: DDS refuses.
  Result<> take(std::ostream* each);

  /// One line on the time since the last call, `seconds` long: rate, latest content, latency.
  std::string line(double seconds);

  /// Saves the newest image into `folder`; does nothing for other content, or without an image.
  virtual Result<> save(const std::filesystem::path& folder, const std::string& prefix);

  const TopicReport& report() const { return report_; }

 protected:
  Subscription(std::string topic, const dds_topic_descriptor_t& type, Qos qos);

  /// Checks a sample, which is valid during the call only, and copies what is needed of it.
  virtual Result<> accept(const void* sample) = 0;
  /// Exposure start of the newest sample.
  virtual TimeMessage stamp(const void* sample) const = 0;
  /// The newest sample in a few words.
  virtual std::string describe() const = 0;

  TopicReport report_;

 private:
  /// Whether it was valid.
  bool count(const void* sample, const dds_sample_info_t& info);

  /// Sums over the samples since the last line().
  struct Interval {
    std::uint64_t samples = 0;
    double since_write_ms = 0;
    double since_exposure_ms = 0;
    double longest_gap_ms = 0;
  };

  Qos qos_;
  TopicReader reader_;
  Interval interval_;
  std::optional<dds_time_t> last_written_;
};

/// A topic of sensor_msgs/Image.
class ImageSubscription final : public Subscription {
 public:
  /// `keep`: the newest image is wanted by save().
  ImageSubscription(std::string topic, bool keep);
  Result<> save(const std::filesystem::path& folder, const std::string& prefix) override;

 private:
  Result<> accept(const void* sample) override;
  TimeMessage stamp(const void* sample) const override;
  std::string describe() const override;

  bool keep_;
  ReceivedImage newest_;  ///< its data, if kept, are bytes_
  std::vector<std::uint8_t> bytes_;
};

/// A topic of sensor_msgs/CompressedImage that carries JPEG. The header of each picture is checked,
/// its data when it is saved.
class CompressedImageSubscription final : public Subscription {
 public:
  /// `keep`: the newest image is wanted by save().
  CompressedImageSubscription(std::string topic, bool keep);
  Result<> save(const std::filesystem::path& folder, const std::string& prefix) override;

 private:
  Result<> accept(const void* sample) override;
  TimeMessage stamp(const void* sample) const override;
  std::string describe() const override;

  bool keep_;
  hal::JpegDecoder decoder_;
  hal::JpegSize size_;
  std::size_t length_ = 0;  ///< bytes
  std::vector<std::uint8_t> jpeg_;
};

/// A topic of process states.
class ProcessStateSubscription final : public Subscription {
 public:
  explicit ProcessStateSubscription(std::string topic);

 private:
  Result<> accept(const void* sample) override;
  TimeMessage stamp(const void* sample) const override;
  std::string describe() const override;

  std::string newest_;
};

}  // namespace orbwatch::app
