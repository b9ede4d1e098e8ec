// SPDX-License-Identifier: Apache-2.0
#include "hal/replay/replay_camera.h"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>

#include "hal/module/load_module.h"
#include "hal/module/module_list.h"
#include "hal/recording/camera_recording.h"
#include "hal/replay/picture_folder.h"
#include "hal/replay/recorded_pictures.h"

namespace orbwatch::hal {
namespace {

constexpr double kFolderFrameRate = 30.0;
constexpr std::chrono::seconds kReportedLateness{1};

Clock::duration offset(std::uint64_t exposure, double frame_rate) {
  return std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(static_cast<double>(exposure) / frame_rate));
}

/// Newest exposure that is due `elapsed` after the start.
std::uint64_t exposure_at(Clock::duration elapsed, double frame_rate) {
  return static_cast<std::uint64_t>(std::chrono::duration<double>(elapsed).count() * frame_rate);
}

std::string to_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

/// Opens a folder of pictures, one picture, a recording or a video file.
Result<std::unique_ptr<Recording>> open_recording(const ReplaySettings& settings) {
  const auto& [name, source, rate, loop, faults] = settings;
  std::error_code error;
  const auto status = std::filesystem::status(source, error);
  if (error) return fail(source.string() + ": " + error.message());
  if (std::filesystem::is_directory(status) || has_picture_name(source)) {
    return PictureFolder::open(source, loop);
  }
  if (recording::has_recording_name(source)) return RecordedPictures::open(source, name, loop);
  if (std::filesystem::is_regular_file(status)) {
    return module_of(kVideoModule).and_then([&](const CameraModule* module) {
      return module->open_recording(settings.source, settings.loop);
    });
  }
  return fail(source.string() +
              ": is neither a folder of pictures nor a recording or a video file");
}

}  // namespace

ReplayCamera::ReplayCamera(ReplaySettings settings)
    : Camera({settings.name, settings.source.filename().string(), "replay"}),
      settings_(std::move(settings)),
      script_(settings_.faults) {}

ReplayCamera::~ReplayCamera() { stop(); }

Result<StreamFormat> ReplayCamera::do_configure(const StreamRequest& request) {
  const std::string who = "camera " + info().id + ": ";
  auto recording = open_recording(settings_);
  if (!recording) return fail(who + recording.error().message);
  StreamFormat format = (*recording)->format();
  if ((request.width != 0 && request.width != format.width) ||
      (request.height != 0 && request.height != format.height)) {
    return fail(who + "asked for " + to_text(request.width, request.height) +
                ", the recording has " + to_text(format.width, format.height) +
                (*recording)->size_note());
  }
  for (const double rate :
       {kFolderFrameRate, format.frame_rate, settings_.frame_rate, request.frame_rate}) {
    if (rate != 0) format.frame_rate = rate;
  }
  if (!(format.frame_rate > 0 && format.frame_rate <= kMaxFrameRate)) {
    return fail(who + "frame rate " + std::to_string(format.frame_rate) +
                "; it must be above 0 and at most " + std::to_string(kMaxFrameRate) +
                " per second");
  }
  recording_ = std::move(*recording);
  format_ = format;
  pool_ = make_frame_pool(format.format, format.width, format.height, request.buffers);
  return format;
}

std::string ReplayCamera::format_note() const {
  return recording_ ? recording_->size_note() : std::string();
}

void ReplayCamera::run(const std::stop_token& stop) {
  const TimePoint start = Clock::now();
  for (std::uint64_t number = 0; wait_until(start + moment(number).offset);) {
    if (!expose(number, start, stop)) return;
    number = next(number, Clock::now() - start);
  }
}

/// Exposure of a picture, recorded or by the rate.
RecordedMoment ReplayCamera::moment(std::uint64_t number) const {
  const auto recorded = recording_->moment(number);
  return recorded ? *recorded : RecordedMoment{offset(number, format_.frame_rate), number};
}

/// The picture that follows `number`; later ones when it is late.
std::uint64_t ReplayCamera::next(std::uint64_t number, Clock::duration elapsed) const {
  if (!recording_->moment(number)) {
    return std::max(number + 1, exposure_at(elapsed, format_.frame_rate));
  }
  const bool is_late = moment(number + 1).offset + kReportedLateness < elapsed;
  for (++number; is_late && moment(number + 1).offset <= elapsed;) ++number;
  return number;
}

/// Makes one exposure; false when the recording is over.
bool ReplayCamera::expose(std::uint64_t number, TimePoint start, const std::stop_token& stop) {
  const RecordedMoment recorded = moment(number);
  const TimePoint due = start + recorded.offset;
  const FrameMetadata metadata{.sequence = recorded.sequence,
                               .exposure_start = due,
                               .trigger = recorded.trigger,
                               .recorded_set = recorded.set_time};
  if (fails(script_, metadata)) return true;
  const auto buffer = pool_->acquire();
  if (!buffer) return true;  // lost: all buffers are in use
  buffer->metadata = metadata;
  if (const auto shown = recording_->show(number, *buffer, stop); !shown) {
    const auto& [fault, detail] = shown.error();
    if (fault == Fault::CorruptFrame) {
      discard(metadata, detail);
    } else {
      report(fault, detail);
    }
    return fault != Fault::Unplugged;
  }
  if (Clock::now() - due > kReportedLateness) {
    report(Fault::Stalled, "the recording decodes slower than it is played");
  }
  buffer->picture.colour_space = format_.colour_space;
  deliver(buffer);
  return true;
}

std::unique_ptr<Camera> make_camera(ReplaySettings settings, const CameraContext& context) {
  settings.name = context.name;
  settings.frame_rate = context.frame_rate;
  settings.faults = context.faults;
  return std::make_unique<ReplayCamera>(std::move(settings));
}

}  // namespace orbwatch::hal
