// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "app/model/sink/recorded_camera.h"
#include "app/pictures/jpeg_encoder.h"
#include "app/ports/recorder/events/event_settings.h"
#include "app/ports/recorder/events/frame_ring.h"
#include "app/ports/recorder/log_file.h"
#include "hal/mcap/fields.h"
#include "hal/recording/recorded_clock.h"

namespace orbwatch::app::recorder {

/// The recording of an event: the log's messages and the cameras' pictures. All stamps of the file
/// are converted to UTC by one difference, so that intervals are those of the steady clock; the
/// messages of a frame set have its stamp as their log time. Thread-bound; waits for the disk.
class EventFile {
 public:
  /// Creates the file. `cameras` by index in the frame sets; the references are the caller's and
  /// outlive this. `moment` and `utc` are the same. Errors: of the disk.
  static hal::mcap::FileResult<EventFile> create(const std::filesystem::path& path,
                                                 const RecordedTexts& texts,
                                                 const EventSettings& settings,
                                                 const std::vector<RecordedCamera>& cameras,
                                                 hal::TimePoint moment, Utc utc);

  hal::mcap::FileResult<> write(const LogMessage& message);
  /// Codes and writes a picture; JPEG data of a camera is written as it is. False: the picture is
  /// left out, because its camera has changed its scale, or from pixels to JPEG data, or back,
  /// since the first one. Errors: of the disk; a picture that cannot be coded.
  hal::mcap::FileResult<bool> write(const KeptFrame& frame);

  /// Hands everything to the disk, and waits until it is there.
  hal::mcap::FileResult<> flush() { return log_.flush(); }
  hal::mcap::FileResult<> finish();

  Utc utc(hal::TimePoint moment) const {
    return Utc(
        std::chrono::duration_cast<Utc::duration>(std::chrono::nanoseconds(clock_.to_utc(moment))));
  }
  /// Pictures by camera.
  const std::vector<std::uint64_t>& pictures() const { return pictures_; }
  std::uint64_t size() const { return log_.size(); }

 private:
  /// Topics of a camera.
  struct Channels {
    std::uint16_t pictures = 0, places = 0;
    bool is_raw = false;
    double kelvin_per_count = 0;
  };

  EventFile(LogFile log, const EventSettings& settings, const std::vector<RecordedCamera>& cameras,
            hal::recording::RecordedClock clock)
      : log_(std::move(log)),
        settings_(&settings),
        cameras_(&cameras),
        clock_(clock),
        channels_(cameras.size()),
        pictures_(cameras.size()) {}

  bool is_raw(const KeptFrame& frame) const;
  hal::mcap::FileResult<> add_camera(const KeptFrame& frame);
  void encode_jpeg(std::span<const std::byte> jpeg, std::string_view format,
                   const hal::recording::Header& header);
  hal::mcap::FileResult<> encode(const KeptFrame& frame, const hal::recording::Header& header);

  LogFile log_;
  const EventSettings* settings_;
  const std::vector<RecordedCamera>* cameras_;
  hal::recording::RecordedClock clock_;
  std::vector<std::optional<Channels>> channels_;
  std::vector<std::uint64_t> pictures_;
  JpegEncoder jpeg_;
  hal::mcap::Bytes pixels_, message_;  ///< reused
};

}  // namespace orbwatch::app::recorder
