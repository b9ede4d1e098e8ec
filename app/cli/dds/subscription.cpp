// SPDX-License-Identifier: Apache-2.0
#include "app/cli/dds/subscription.h"

#include <algorithm>
#include <span>
#include <vector>

#include "app/cli/dds/received_image.h"
#include "app/cli/dds/received_state.h"
#include "app/cli/dds/writer_types.h"
#include "app/ports/dds/pictures/image_message.h"
#include "hal/jpeg/jpeg_decoder.h"

namespace orbwatch::app::cli {

namespace {

constexpr std::string_view kRosTopic = "rt/";
constexpr std::string_view kImage = "/image_raw";
constexpr std::string_view kCompressed = "/compressed";
constexpr std::string_view kProcessState = "/process_state";

bool is_file_name_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == '.';
}

/// Adds a history that bridges a pause of the reader.
dds::Qos deep(dds::Qos qos) {
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, dds::kMaxTaken);
  return qos;
}

/// Computes in floating point, because a foreign writer may send any stamp.
double milliseconds_between(dds_time_t earlier, dds_time_t later) {
  return (static_cast<double>(later) - static_cast<double>(earlier)) * 1e-6;
}

std::string size_text(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

/// Topic of sensor_msgs/Image.
class ImageSubscription final : public Subscription {
 public:
  ImageSubscription(const std::string& topic, bool keep)
      : Subscription(sensor_msgs_msg_dds__Image__desc, topic, dds::frame_qos()), keep_(keep) {}

 private:
  Result<Content> accept(const void* sample) override {
    const auto& message = *static_cast<const dds::ImageMessage*>(sample);
    const auto image = check_image(message);
    if (!image) return tl::unexpected(image.error());
    if (keep_) {
      newest_ = *image;
      bytes_.assign(image->data, image->data + message.data._length);
      newest_.data = bytes_.data();
    }
    return Content{message.header.stamp, size_text(image->width, image->height) + " " +
                                             std::string(image->encoding.name)};
  }

  bool has_picture() const override { return newest_.data != nullptr; }
  Result<> write_png(const std::filesystem::path& path) const override {
    return save_png(newest_, path);
  }

  bool keep_;
  ReceivedImage newest_;  ///< its data, if kept, point to bytes_
  std::vector<std::uint8_t> bytes_;
};

/// Topic of sensor_msgs/CompressedImage that carries JPEG. The header of each picture is checked on
/// arrival, its data when it is saved.
class CompressedImageSubscription final : public Subscription {
 public:
  CompressedImageSubscription(const std::string& topic, bool keep)
      : Subscription(sensor_msgs_msg_dds__CompressedImage__desc, topic, dds::frame_qos()),
        keep_(keep) {}

 private:
  Result<Content> accept(const void* sample) override {
    const auto& message = *static_cast<const dds::CompressedImageMessage*>(sample);
    const std::span jpeg(message.data._buffer, message.data._length);
    const auto size = decoder_.read_size(std::as_bytes(jpeg));
    if (!size) return tl::unexpected(size.error());
    const auto width = static_cast<std::uint32_t>(size->width);
    const auto height = static_cast<std::uint32_t>(size->height);
    if (const auto checked = check_image_size(width, height); !checked) {
      return tl::unexpected(checked.error());
    }
    if (keep_) jpeg_.assign(jpeg.begin(), jpeg.end());
    return Content{message.header.stamp,
                   size_text(width, height) + " jpeg, " + std::to_string(jpeg.size()) + " bytes"};
  }

  bool has_picture() const override { return !jpeg_.empty(); }
  Result<> write_png(const std::filesystem::path& path) const override {
    return save_jpeg_as_png(jpeg_, path);
  }

  bool keep_;
  hal::JpegDecoder decoder_;
  std::vector<std::uint8_t> jpeg_;
};

/// Topic of process states.
class ProcessStateSubscription final : public Subscription {
 public:
  explicit ProcessStateSubscription(const std::string& topic)
      : Subscription(orbwatch_msgs_msg_dds__ProcessState__desc, topic, dds::state_qos()) {}

 private:
  Result<Content> accept(const void* sample) override {
    const auto& message = *static_cast<const dds::ProcessStateMessage*>(sample);
    const auto state = check_process_state(message);
    if (!state) return tl::unexpected(state.error());
    return Content{message.header.stamp,
                   std::string(name_of(state->system_state)) + ", frame set " +
                       std::to_string(state->frame_set) +
                       (state->trigger != 0 ? ", trigger " + std::to_string(state->trigger) : "") +
                       ", heartbeat " + std::to_string(state->heartbeat)};
  }
};

}  // namespace

bool is_compressed_topic(std::string_view topic) { return topic.ends_with(kCompressed); }

bool is_process_state_topic(std::string_view topic) { return topic.ends_with(kProcessState); }

std::string readable_types() {
  return "topics that end in " + std::string(kProcessState) + " are read as " +
         type_text(orbwatch_msgs_msg_dds__ProcessState__desc.m_typename) + ", in " +
         std::string(kCompressed) + " as " +
         type_text(sensor_msgs_msg_dds__CompressedImage__desc.m_typename) + ", all others as " +
         type_text(sensor_msgs_msg_dds__Image__desc.m_typename);
}

std::string full_topic(std::string_view topic) {
  if (topic.starts_with('/')) topic.remove_prefix(1);
  if (topic.starts_with(kRosTopic)) return std::string(topic);
  return std::string(kRosTopic).append(topic);
}

std::string file_stem(std::string_view topic, std::string_view prefix) {
  if (topic.starts_with(kRosTopic)) topic.remove_prefix(kRosTopic.size());
  if (topic.starts_with(prefix) && topic.substr(prefix.size()).starts_with('/')) {
    topic.remove_prefix(prefix.size() + 1);
  }
  const bool compressed = is_compressed_topic(topic);
  if (compressed) topic.remove_suffix(kCompressed.size());
  if (topic.ends_with(kImage)) topic.remove_suffix(kImage.size());
  std::string stem(topic.empty() ? "image" : topic);
  if (compressed) stem += "-compressed";
  std::ranges::replace(stem, '/', '-');
  std::ranges::replace_if(
      stem, [](char c) { return !is_file_name_letter(c); }, '_');
  if (stem.front() == '.') stem.front() = '_';
  return stem;
}

std::unique_ptr<Subscription> Subscription::make(const std::string& topic, bool keep) {
  if (is_process_state_topic(topic)) return std::make_unique<ProcessStateSubscription>(topic);
  if (is_compressed_topic(topic)) return std::make_unique<CompressedImageSubscription>(topic, keep);
  return std::make_unique<ImageSubscription>(topic, keep);
}

Subscription::Subscription(const dds_topic_descriptor_t& type, std::string topic, dds::Qos qos)
    : qos_(deep(std::move(qos))), reader_(type, topic) {
  report_.topic = std::move(topic);
}

Result<> Subscription::take(const std::function<void(const TopicSample&)>& each) {
  const auto taken =
      dds::take_samples(reader_.get(), [&](const void* sample, const dds_sample_info_t& info) {
        const auto content = accept(sample);
        if (!content) {
          ++report_.refused;
          report_.refusal = content.error().message;
          return;
        }
        const TopicSample valid = count(*content, info.source_timestamp);
        if (each) each(valid);
      });
  if (!taken) return fail(taken.error().message + " (" + report_.topic + ")");
  dds_sample_lost_status_t lost{};
  const dds_return_t code = dds_get_sample_lost_status(reader_.get(), &lost);
  if (code < 0) return tl::unexpected(dds::dds_error("losses of " + report_.topic, code));
  report_.lost = lost.total_count;
  return {};
}

TopicSample Subscription::count(const Content& content, dds_time_t written) {
  ++report_.received;
  ++interval_.samples;
  newest_ = content.text;
  if (last_written_) {
    const double gap = milliseconds_between(*last_written_, written);
    interval_.longest_gap_ms = std::max(interval_.longest_gap_ms, gap);
    report_.longest_gap_ms = std::max(report_.longest_gap_ms, gap);
  }
  last_written_ = written;
  const dds_time_t now = dds_time();
  interval_.since_write_ms += milliseconds_between(written, now);
  const double age = milliseconds_between(dds::since_epoch(content.stamp).count(), now);
  interval_.since_exposure_ms += age;
  return {report_.topic, content.text, age};
}

TopicFigures Subscription::figures(double seconds) {
  const Interval interval = std::exchange(interval_, {});
  const double count = std::max<double>(static_cast<double>(interval.samples), 1);
  return {.topic = report_.topic,
          .seconds = seconds,
          .samples = interval.samples,
          .longest_gap_ms = interval.longest_gap_ms,
          .since_write_ms = interval.since_write_ms / count,
          .since_exposure_ms = interval.since_exposure_ms / count,
          .newest = newest_,
          .lost = report_.lost,
          .refused = report_.refused,
          .refusal = report_.refusal};
}

Result<> Subscription::save(const std::filesystem::path& folder, const std::string& prefix) {
  if (!has_picture()) return {};
  const auto path = folder / (file_stem(report_.topic, prefix) + ".png");
  return write_png(path).map([&] { report_.saved = path; });
}

}  // namespace orbwatch::app::cli
