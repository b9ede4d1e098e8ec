// SPDX-License-Identifier: Apache-2.0
#include "hal/video/video_file.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <utility>

namespace orbwatch::hal {

struct VideoFile::Decoder {
  cv::VideoCapture capture;
  cv::Mat picture;  ///< picture that was decoded last, B G R; made once and reused
};

VideoFile::VideoFile(std::filesystem::path file, bool loop)
    : file_(std::move(file)), loop_(loop), decoder_(std::make_unique<Decoder>()) {}

VideoFile::~VideoFile() = default;

Result<std::unique_ptr<Recording>> VideoFile::open(const std::filesystem::path& file, bool loop) {
  try {
    std::unique_ptr<VideoFile> video(new VideoFile(std::filesystem::absolute(file), loop));
    if (!video->rewind()) return fail(file.string() + ": is not a video that FFmpeg can read");
    if (!video->decode_next() || video->decoder_->picture.type() != CV_8UC3) {
      return fail(file.string() + ": its first picture cannot be decoded");
    }
    const double rate = video->decoder_->capture.get(cv::CAP_PROP_FPS);
    video->format_ = {PixelFormat::Rgb,
                      {ColourMatrix::Bt601, ColourRange::Full},
                      video->decoder_->picture.cols,
                      video->decoder_->picture.rows,
                      std::isfinite(rate) && rate > 0 ? rate : 0.0};
    return video;
  } catch (const std::exception& error) {
    return fail(file.string() + ": cannot be decoded: " + error.what());
  }
}

bool VideoFile::rewind() {
  position_ = 0;
  return decoder_->capture.open(file_.string(), cv::CAP_FFMPEG);
}

bool VideoFile::skip_to(std::uint64_t number, const std::stop_token& stop) {
  while (position_ < number && !stop.stop_requested()) {
    if (!decoder_->capture.grab()) return false;
    ++position_;
  }
  return true;
}

bool VideoFile::decode_next() {
  if (!decoder_->capture.read(decoder_->picture)) return false;
  ++position_;
  return true;
}

DeviceResult<> VideoFile::show(std::uint64_t number, FrameBuffer& target,
                               const std::stop_token& stop) {
  const auto failed = [this](Fault fault, const std::string& what) {
    return fail(fault, file_.string() + ": " + what);
  };
  try {
    while (count_ != 0) {
      if (count_ && number >= *count_) {
        if (!loop_) return fail(Fault::Unplugged, "end of recording");
        number %= *count_;
      }
      if (number < position_ && !rewind())
        return failed(Fault::Unplugged, "cannot be opened again");
      if (skip_to(number, stop) && decode_next()) return copy_to(target);
      count_ = position_;
    }
    return failed(Fault::Unplugged, "can no longer be decoded");
  } catch (const std::exception& error) {
    return failed(Fault::CorruptFrame, error.what());
  }
}

DeviceResult<> VideoFile::copy_to(FrameBuffer& target) const {
  const cv::Mat& picture = decoder_->picture;
  if (picture.type() != CV_8UC3 || picture.cols != format_.width ||
      picture.rows != format_.height) {
    return fail(Fault::WrongFormat, file_.string() + ": picture " + std::to_string(position_ - 1) +
                                        " is " + std::to_string(picture.cols) + "x" +
                                        std::to_string(picture.rows));
  }
  cv::Mat pixels(format_.height, format_.width, CV_8UC3, target.memory,
                 static_cast<std::size_t>(target.picture.planes[0].stride));
  cv::cvtColor(picture, pixels, cv::COLOR_BGR2RGB);
  return {};
}

}  // namespace orbwatch::hal
