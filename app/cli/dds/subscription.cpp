#include "app/cli/dds/subscription.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <ostream>
#include <span>

#include "app/cli/dds/image_file.h"
#include "app/cli/dds/received_state.h"
#include "app/cli/dds/subscribed_topic.h"
#include "app/ports/dds/pictures/image_message.h"
#include "app/ports/dds/topics/topic_reader.h"

namespace orbwatch::app {

namespace {

/// With a history that bridges a pause of the reader.
Qos deep(Qos qos) {
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, kMaxTaken);
  return qos;
}

/// In floating point: a foreign writer may send any stamp.
double milliseconds_between(dds_time_t earlier, dds_time_t later) {
  return (static_cast<double>(later) - static_cast<double>(earlier)) * 1e-6;
}

}  // namespace

Subscription::Subscription(std::string topic, const dds_topic_descriptor_t& type, Qos qos)
    : qos_(std::move(qos)), reader_(type, topic) {
  report_.topic = std::move(topic);
}

Result<> Subscription::take(std::ostream* each) {
  const auto taken =
      take_samples(reader_.get(), [&](const void* sample, const dds_sample_info_t& info) {
        if (count(sample, info) && each != nullptr) {
          *each << report_.topic << ": " << describe() << '\n';
        }
      });
  if (!taken) return fail(taken.error().message + " (" + report_.topic + ")");
  dds_sample_lost_status_t lost{};
  const dds_return_t code = dds_get_sample_lost_status(reader_.get(), &lost);
  if (code < 0) return tl::unexpected(dds_error("losses of " + report_.topic, code));
  report_.lost = lost.total_count;
  return {};
}

bool Subscription::count(const void* sample, const dds_sample_info_t& info) {
  if (const auto accepted = accept(sample); !accepted) {
    ++report_.refused;
    report_.refusal = accepted.error().message;
    return false;
  }
  ++report_.received;
  ++interval_.samples;
  if (last_written_) {
    const double gap = milliseconds_between(*last_written_, info.source_timestamp);
    interval_.longest_gap_ms = std::max(interval_.longest_gap_ms, gap);
    report_.longest_gap_ms = std::max(report_.longest_gap_ms, gap);
  }
  last_written_ = info.source_timestamp;
  const dds_time_t now = dds_time();
  interval_.since_write_ms += milliseconds_between(info.source_timestamp, now);
  interval_.since_exposure_ms += milliseconds_between(since_epoch(stamp(sample)).count(), now);
  return true;
}

std::string Subscription::line(double seconds) {
  const Interval interval = std::exchange(interval_, {});
  std::string text = report_.topic + ": ";
  if (interval.samples == 0) {
    text += "nothing";
  } else {
    const auto count = static_cast<double>(interval.samples);
    std::array<char, 160> figures{};
    std::snprintf(figures.data(), figures.size(),
                  "%.1f/s, longest gap %.0f ms, latency %.1f ms from writing, %.1f ms from "
                  "exposure, ",
                  count / seconds, interval.longest_gap_ms, interval.since_write_ms / count,
                  interval.since_exposure_ms / count);
    text += figures.data() + describe();
  }
  text += ", lost " + std::to_string(report_.lost);
  if (report_.refused > 0) {
    text += ", refused " + std::to_string(report_.refused) + " (" + report_.refusal + ")";
  }
  return text;
}

Result<> Subscription::save(const std::filesystem::path&, const std::string&) { return {}; }

ImageSubscription::ImageSubscription(std::string topic, bool keep)
    : Subscription(std::move(topic), sensor_msgs_msg_dds__Image__desc, deep(frame_qos())),
      keep_(keep) {}

Result<> ImageSubscription::accept(const void* sample) {
  const auto& message = *static_cast<const ImageMessage*>(sample);
  const auto image = check_image(message);
  if (!image) return tl::unexpected(image.error());
  newest_ = *image;
  newest_.data = nullptr;
  if (!keep_) return {};
  bytes_.assign(image->data, image->data + message.data._length);
  newest_.data = bytes_.data();
  return {};
}

TimeMessage ImageSubscription::stamp(const void* sample) const {
  return static_cast<const ImageMessage*>(sample)->header.stamp;
}

std::string ImageSubscription::describe() const {
  return std::to_string(newest_.width) + "x" + std::to_string(newest_.height) + " " +
         std::string(newest_.encoding.name);
}

Result<> ImageSubscription::save(const std::filesystem::path& folder, const std::string& prefix) {
  if (newest_.data == nullptr) return {};
  const auto path = folder / (file_stem(report_.topic, prefix) + ".png");
  if (const auto saved = save_png(newest_, path); !saved) return saved;
  report_.saved = path;
  return {};
}

CompressedImageSubscription::CompressedImageSubscription(std::string topic, bool keep)
    : Subscription(std::move(topic), sensor_msgs_msg_dds__CompressedImage__desc, deep(frame_qos())),
      keep_(keep) {}

Result<> CompressedImageSubscription::accept(const void* sample) {
  const auto& data = static_cast<const CompressedImageMessage*>(sample)->data;
  const auto size = decoder_.read_size(std::as_bytes(std::span(data._buffer, data._length)));
  if (!size) return tl::unexpected(size.error());
  constexpr int kMaxJpegSide = static_cast<int>(kMaxImageSide);
  if (size->width > kMaxJpegSide || size->height > kMaxJpegSide) {
    return fail("image: " + std::to_string(size->width) + " x " + std::to_string(size->height) +
                " pixels, each side must be 1 to " + std::to_string(kMaxImageSide));
  }
  size_ = *size;
  length_ = data._length;
  if (keep_) jpeg_.assign(data._buffer, data._buffer + data._length);
  return {};
}

TimeMessage CompressedImageSubscription::stamp(const void* sample) const {
  return static_cast<const CompressedImageMessage*>(sample)->header.stamp;
}

std::string CompressedImageSubscription::describe() const {
  return std::to_string(size_.width) + "x" + std::to_string(size_.height) + " jpeg, " +
         std::to_string(length_) + " bytes";
}

Result<> CompressedImageSubscription::save(const std::filesystem::path& folder,
                                           const std::string& prefix) {
  if (jpeg_.empty()) return {};
  const auto path = folder / (file_stem(report_.topic, prefix) + ".png");
  if (const auto saved = save_jpeg_as_png(jpeg_, path); !saved) return saved;
  report_.saved = path;
  return {};
}

ProcessStateSubscription::ProcessStateSubscription(std::string topic)
    : Subscription(std::move(topic), orbwatch_msgs_msg_dds__ProcessState__desc, deep(state_qos())) {
}

Result<> ProcessStateSubscription::accept(const void* sample) {
  const auto state = check_process_state(*static_cast<const ProcessStateMessage*>(sample));
  if (!state) return tl::unexpected(state.error());
  const std::string_view text = operator_text(state->system_state);
  newest_ = std::string(text.substr(0, text.find(':'))) + ", frame set " +
            std::to_string(state->frame_set) +
            (state->trigger != 0 ? ", trigger " + std::to_string(state->trigger) : "") +
            ", heartbeat " + std::to_string(state->heartbeat);
  return {};
}

TimeMessage ProcessStateSubscription::stamp(const void* sample) const {
  return static_cast<const ProcessStateMessage*>(sample)->header.stamp;
}

std::string ProcessStateSubscription::describe() const { return newest_; }

}  // namespace orbwatch::app
