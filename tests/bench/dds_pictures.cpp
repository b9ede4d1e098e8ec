// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/dds_pictures.h"

#include <opencv2/imgproc.hpp>
#include <vector>

#include "app/ports/dds/topics/topic_names.h"
#include "tests/app/ports/dds/fastdds/paced_views.h"
#include "tests/app/ports/dds/fastdds/shipped_network.h"

namespace orbwatch::bench {

namespace {

using app::tests::Pace;

constexpr int kWidth = 1920;
constexpr int kHeight = 1080;
constexpr std::size_t kJpegBytes = 340'000;
constexpr std::size_t kPictures = 8;  // more than the sink keeps of a view
constexpr const char* kPrefix = "orbwatch";
constexpr const char* kView = "front";
constexpr const char* kCamera = "colour";

std::vector<std::shared_ptr<app::View>> make_views(int width, int height) {
  std::vector<std::shared_ptr<app::View>> views;
  for (std::uint64_t set = 1; set <= kPictures; ++set) {
    views.push_back(app::tests::make_view(0, kView, set, width, height));
  }
  return views;
}

/// Views whose JPEG at the best quality is larger than the target: noise like a grainy camera's.
std::vector<std::shared_ptr<app::View>> make_grainy_views() {
  auto views = make_views(kWidth, kHeight);
  cv::RNG grain(1);
  for (const auto& view : views) {
    cv::Mat pixels(kHeight, kWidth, CV_8UC3, view->picture.samples<std::uint8_t>().row(0),
                   view->picture.samples<std::uint8_t>().stride);
    cv::Mat noise(pixels.size(), pixels.type());
    grain.fill(noise, cv::RNG::NORMAL, 128, 40);
    cv::GaussianBlur(noise, pixels, {5, 5}, 0);
  }
  return views;
}

/// Frame sets, each with a new frame of the first camera.
class PacedFrames final : public Pace {
 public:
  explicit PacedFrames(app::Sink& sink) : sink_(sink) {
    for (auto& frame : frames_) {
      frame = std::make_shared<hal::FrameBuffer>();
      const std::size_t size = std::size_t{kWidth} * kHeight * 3 / 2;
      frame->storage = std::make_unique<std::byte[]>(size);
      std::fill_n(frame->storage.get(), size, std::byte{128});
      frame->picture =
          Picture::contiguous(PixelFormat::Nv12, kWidth, kHeight, frame->storage.get(), kWidth);
    }
  }

 private:
  void hand_over_now(std::uint64_t number) override {
    set_.id = number;
    set_.stamp = hal::Clock::now();
    set_.frames[0] = frames_[number % frames_.size()];
    sink_.accept_frames(set_);
    status_.frame_set = number;
    status_.stamp = set_.stamp;
    sink_.accept(status_);
  }

  app::Sink& sink_;
  std::array<std::shared_ptr<hal::FrameBuffer>, kPictures> frames_;
  hal::FrameSet set_;
  app::Status status_;
};

}  // namespace

app::DdsSettings settings_for(Pictures pictures) {
  app::DdsSettings settings{.domain = app::tests::kDomain};
  settings.prefix = kPrefix;
  if (pictures == Pictures::Jpeg) settings.jpeg.target_bytes = kJpegBytes;
  return settings;
}

std::vector<app::PublishedCamera> cameras_for(Pictures pictures) {
  if (pictures != Pictures::Camera) return {};
  return {{.encoding = PixelFormat::Grey}};
}

std::string topic_of(Pictures pictures) {
  if (pictures == Pictures::Camera) return app::dds::ball_topic(kPrefix, kCamera);
  const std::string raw = app::dds::image_topic(kPrefix, kView);
  return pictures == Pictures::Jpeg ? app::dds::compressed_topic(raw) : raw;
}

std::unique_ptr<Pace> paced(Pictures pictures, app::Sink& sink) {
  using app::tests::PacedViews;
  switch (pictures) {
    case Pictures::View:
      return std::make_unique<PacedViews>(sink, make_views(kWidth, kHeight));
    case Pictures::SmallView:
      return std::make_unique<PacedViews>(sink, make_views(400, 250));
    case Pictures::Jpeg:
      return std::make_unique<PacedViews>(sink, make_grainy_views());
    case Pictures::Camera:
      break;
  }
  return std::make_unique<PacedFrames>(sink);
}

}  // namespace orbwatch::bench
