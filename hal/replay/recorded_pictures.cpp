// SPDX-License-Identifier: Apache-2.0
#include "hal/replay/recorded_pictures.h"

namespace orbwatch::hal {
namespace {

using recording::CameraIndex;
using std::chrono::nanoseconds;

/// Pause before a recording of one frame set restarts.
constexpr nanoseconds kSinglePeriod = std::chrono::seconds(1);

/// Time after which a looped recording restarts.
nanoseconds length_of(const recording::RecordedTime& time) {
  const nanoseconds period = time.period > nanoseconds(0) ? time.period : kSinglePeriod;
  return nanoseconds(time.end - time.begin) + period;
}

}  // namespace

Result<std::unique_ptr<Recording>> RecordedPictures::open(const std::filesystem::path& file,
                                                          std::string_view camera, bool loop) {
  auto recording = recording::CameraRecording::open(file, camera);
  if (!recording) return tl::unexpected(recording.error());
  return std::unique_ptr<Recording>(new RecordedPictures(std::move(*recording), loop));
}

std::optional<RecordedMoment> RecordedPictures::moment(std::uint64_t number) const {
  const CameraIndex& index = recording_.index();
  const auto& exposures = index.exposures;
  const std::uint64_t round = number / exposures.size();
  const auto& exposure = exposures[static_cast<std::size_t>(number % exposures.size())];
  const std::uint32_t first = exposures.front().sequence;
  RecordedMoment moment;
  moment.offset = nanoseconds(static_cast<std::int64_t>(exposure.start - index.time.begin)) +
                  static_cast<std::int64_t>(round) * length_of(index.time);
  moment.set_time = exposure.set_time;
  const std::uint32_t last = exposures.back().sequence - first;  // modulo 2^32, as they wrap
  moment.sequence = (exposure.sequence - first) + round * (std::uint64_t{last} + 1);
  if (exposure.trigger) moment.trigger = *exposure.trigger + round * index.triggers;
  return moment;
}

DeviceResult<> RecordedPictures::show(std::uint64_t number, FrameBuffer& target,
                                      const std::stop_token&) {
  const CameraIndex& index = recording_.index();
  const StreamFormat& format = index.format;
  if (!loop_ && number >= index.exposures.size()) {
    return fail(Fault::Unplugged, "end of recording");
  }
  const auto picture = MutablePicture::contiguous(format.format, format.width, format.height,
                                                  target.memory, target.picture.planes[0].stride);
  const auto shown =
      recording_.read(static_cast<std::size_t>(number % index.exposures.size()), picture);
  if (!shown) return fail(Fault::CorruptFrame, shown.error().message);
  target.metadata.status = *shown;
  return {};
}

}  // namespace orbwatch::hal
