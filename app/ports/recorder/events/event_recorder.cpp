// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_recorder.h"

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "app/model/status/utc_text.h"
#include "app/ports/recorder/events/ring_size.h"
#include "app/ports/recorder/events/trigger_picture.h"
#include "hal/atomic_file.h"

namespace orbwatch::app::recorder {
namespace {

/// Time for which messages are kept longer than events need them, since triggers wait for the disk.
constexpr std::chrono::seconds kLongestWait{10};

std::size_t ring_bytes(const EventSettings& settings) {
  return static_cast<std::size_t>(settings.ring_mib) << 20;
}

/// Least bytes of a picture, whatever the formats of the cameras are going to be.
std::size_t least_bytes(const std::vector<RecordedCamera>& cameras) {
  std::size_t least = std::size_t{1} << 20;
  for (const RecordedCamera& camera : cameras) {
    constexpr std::size_t kBestCompression = 8;
    const auto pixels =
        static_cast<std::size_t>(camera.ball.width) * static_cast<std::size_t>(camera.ball.height);
    least = std::min(least,
                     camera.format.has_jpeg ? picture_bytes_of(camera) / kBestCompression : pixels);
  }
  return least;
}

std::vector<bool> recorded_ones(const EventSettings& settings,
                                const std::vector<RecordedCamera>& cameras) {
  std::vector<bool> recorded;
  recorded.reserve(cameras.size());
  for (const RecordedCamera& camera : cameras)
    recorded.push_back(is_recorded(settings, camera.name));
  return recorded;
}

Result<> as_result(const hal::mcap::FileResult<>& result) {
  if (result) return {};
  return fail(result.error().message);
}

Result<> write_jpeg(const std::filesystem::path& path, std::span<const std::byte> jpeg) {
  return hal::write_file(path,
                         std::string_view(reinterpret_cast<const char*>(jpeg.data()), jpeg.size()));
}

AlarmCause alarm_cause(const AlarmNotice& notice, const StatusNames& names) {
  return {name_or_number(names.region(notice.recipe, notice.region), notice.region),
          std::string(operator_text(notice.signal)), notice.event.level, notice.event.value,
          std::string(quantity_of(alarm_after(notice)).unit)};
}

}  // namespace

EventRecorder::EventRecorder(const RecorderSettings& settings, std::vector<RecordedCamera> cameras,
                             const StatusNames& names, const RecordedTexts& texts,
                             RecorderCounters& counters)
    : settings_(*settings.events),
      cameras_(std::move(cameras)),
      is_recorded_(recorded_ones(settings_, cameras_)),
      names_(names),
      texts_(texts),
      counters_(counters),
      ring_(ring_bytes(settings_), least_bytes(cameras_)),
      triggers_(settings_, names_.process_inputs, ring_, started_),
      folder_(settings.folder) {
  for (const RecordedCamera& camera : cameras_) delivered_.push_back(camera.format);
}

void EventRecorder::accept_format(std::size_t camera, const hal::StreamFormat& format) {
  delivered_[camera] = format;
}

/// A frame that was in an earlier set is in the ring already.
void EventRecorder::accept_frames(const hal::FrameSet& set) {
  triggers_.begin_set(set.stamp);
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (is_recorded_[i] && set.frames[i] && !set.held[i]) put(set, i);
  }
}

void EventRecorder::put(const hal::FrameSet& set, std::size_t camera) {
  const hal::FrameBuffer& frame = *set.frames[camera];
  const Picture& picture = frame.picture;
  const hal::StreamFormat& planned = cameras_[camera].format;
  KeptFrame kept{camera,
                 set.id,
                 frame.metadata.sequence,
                 set.stamp,
                 frame.metadata.exposure_start,
                 {picture.width, picture.height, {0, 0, picture.width, picture.height}},
                 picture};
  kept.kelvin_per_count = delivered_[camera].kelvin_per_count;
  kept.kelvin_offset = delivered_[camera].kelvin_offset;
  if (!frame.jpeg.empty()) {
    kept.jpeg = frame.jpeg;
  } else if (picture.width == planned.width && picture.height == planned.height) {
    kept.place.region = hal::recording::widened(cameras_[camera].ball, picture.format);
    kept.picture = hal::recording::part_of(picture, kept.place.region);
  }
  ring_.put(kept);
}

void EventRecorder::add_figures(RecorderStatistics& statistics) const {
  constexpr double kMebibyte = 1 << 20;
  const RingUse use = ring_.use();
  statistics.pictures_lost += use.lost;
  statistics.triggers_joined = triggers_.extended();
  statistics.recordings_lost += triggers_.refused();
  statistics.ring_used = static_cast<double>(use.bytes) / kMebibyte;
  statistics.ring_span = std::chrono::duration<double>(use.span).count();
}

/// Text for operators.
std::string EventRecorder::cause_of(const Trigger& trigger) const {
  if (trigger.kind == TriggerKind::Alarm) return event_text(trigger.notice, names_);
  if (trigger.kind != TriggerKind::Line) return std::string(text_of(trigger.kind));
  return "line " + settings_.on_lines[trigger.line] + " became active";
}

EventSummary EventRecorder::summary_of(const Trigger& trigger, Utc triggered) const {
  EventSummary summary;
  summary.trigger = name_of(trigger.kind);
  summary.text = cause_of(trigger);
  if (trigger.kind == TriggerKind::Alarm) summary.alarm = alarm_cause(trigger.notice, names_);
  if (trigger.kind == TriggerKind::Line) summary.line = settings_.on_lines[trigger.line];
  summary.triggered = utc_text(triggered).value_or("");
  summary.frame_set = trigger.frame_set;
  summary.recipe = trigger.recipe;
  summary.part = trigger.part.text();
  summary.layer = trigger.layer;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (is_recorded_[i]) summary.pictures.emplace_back(cameras_[i].name, 0);
  }
  summary.versions = texts_.versions;
  return summary;
}

Result<> EventRecorder::begin_round() {
  for (Running& event : running_) event.is_over = ring_.is_over(event.window);
  while (const auto started = started_.try_take()) {
    if (auto begun = begin(*started); !begun) {
      ring_.release(started->window.number);
      ++counters_.recordings_lost;
      return begun;
    }
  }
  return {};
}

Result<> EventRecorder::begin(const StartedEvent& started) {
  const Trigger& trigger = started.trigger;
  const Utc utc = hal::to_utc(trigger.stamp);
  const auto folder = folder_.begin(utc, trigger.kind);
  if (!folder) return tl::unexpected(folder.error());
  EventSummary summary = summary_of(trigger, utc);
  summary.has_beginning = started.window.is_whole;
  if (auto written = write_summary(*folder, summary); !written) return written;
  auto file =
      EventFile::create(*folder / kEventFile, texts_, settings_, cameras_, trigger.stamp, utc);
  if (!file) return fail(file.error().message);
  Running event{
      started.window.number, false, started.first, trigger.stamp, {}, {}, *folder, std::move(*file),
      std::move(summary)};
  for (const LogMessage& message : recent_) {
    const bool is_in =
        message.stamp >= started.first && message.stamp <= ring_.last_of(started.window.number);
    if (!is_in) continue;
    if (auto written = event.file.write(message); !written) return as_result(written);
  }
  running_.push_back(std::move(event));
  return {};
}

Result<> EventRecorder::keep(LogMessage message) {
  for (Running& event : running_) {
    if (message.stamp < event.first || message.stamp > ring_.last_of(event.window)) continue;
    if (auto written = event.file.write(message); !written) return as_result(written);
  }
  const hal::TimePoint oldest = message.stamp - settings_.before - kLongestWait;
  while (!recent_.empty() && recent_.front().stamp < oldest) recent_.pop_front();
  recent_.push_back(std::move(message));
  return {};
}

Result<bool> EventRecorder::end_round() {
  bool is_more = false;
  for (auto event = running_.begin(); event != running_.end();) {
    if (event->is_over) {
      if (auto finished = finish(*event, false); !finished) return tl::unexpected(finished.error());
      event = running_.erase(event);
      continue;
    }
    if (auto written = write_next(*event); !written) return tl::unexpected(written.error());
    is_more = is_more || ring_.next(event->window) || ring_.is_over(event->window);
    ++event;
  }
  return is_more;
}

Result<> EventRecorder::write_next(Running& event) {
  const auto frame = ring_.next(event.window);
  if (!frame) return {};
  const auto written = event.file.write(*frame);
  if (!written) return fail(written.error().message);
  if (*written) {
    ++counters_.pictures;
  } else {
    ++event.left_out;
  }
  if (!event.first_set) event.first_set = frame->set_stamp;
  event.last_set = frame->set_stamp;
  const bool is_first = !event.has_picture && frame->set_stamp >= event.triggered;
  const auto drawn = is_first ? write_trigger_picture(event, *frame) : Result<>();
  ring_.pass(event.window);
  count_bytes(event);
  return drawn;
}

Result<> EventRecorder::write_trigger_picture(Running& event, const KeptFrame& frame) {
  event.has_picture = true;
  if (!frame.jpeg.empty()) return write_jpeg(event.folder / kEventPicture, frame.jpeg);
  const auto jpeg = jpeg_for_people(jpeg_, frame.picture, settings_.quality);
  if (!jpeg) return tl::unexpected(jpeg.error());
  return hal::write_file(event.folder / kEventPicture, *jpeg);
}

void EventRecorder::count_bytes(Running& event) {
  counters_.bytes += event.file.size() - std::exchange(event.known_size, event.file.size());
}

Result<> EventRecorder::finish(Running& event, bool is_interrupted) {
  const auto text_at = [&](const std::optional<hal::TimePoint>& moment) {
    return moment ? utc_text(event.file.utc(*moment)).value_or("") : std::string();
  };
  event.summary.first = text_at(event.first_set);
  event.summary.last = text_at(event.last_set);
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    for (auto& [camera, pictures] : event.summary.pictures) {
      if (camera == cameras_[i].name) pictures = event.file.pictures()[i];
    }
  }
  event.summary.lost = ring_.lost_of(event.window) + event.left_out;
  event.summary.is_interrupted = is_interrupted;
  auto finished = as_result(event.file.finish())
                      .and_then([&] { return write_summary(event.folder, event.summary); })
                      .and_then([&] { return folder_.finish(event.folder); });
  count_bytes(event);
  if (!finished) return finished;
  ring_.release(event.window);
  ++counters_.recordings;
  return {};
}

Result<> EventRecorder::flush() {
  for (Running& event : running_) {
    auto flushed = event.file.flush();
    count_bytes(event);
    if (!flushed) return as_result(flushed);
  }
  return {};
}

Result<> EventRecorder::end() {
  while (!running_.empty()) {
    if (auto finished = finish(running_.front(), true); !finished) return finished;
    running_.pop_front();
  }
  return {};
}

void EventRecorder::give_up() {
  for (const Running& event : running_) ring_.release(event.window);
  counters_.recordings_lost += running_.size();
  running_.clear();
  while (const auto started = started_.try_take()) {
    ring_.release(started->window.number);
    ++counters_.recordings_lost;
  }
}

}  // namespace orbwatch::app::recorder
