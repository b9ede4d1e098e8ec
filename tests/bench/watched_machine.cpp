// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/watched_machine.h"

#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "proc/align/drift/drift_monitor.h"

namespace orbwatch::bench {
namespace {

constexpr std::size_t kPictures = 8;  // in turn
constexpr std::size_t kFirstSets = 60;

/// Boxes of every size and brightness; edges for the focus, texture for the patches.
cv::Mat room_of_boxes(const cv::Size& size) {
  cv::Mat room(size, CV_32F, cv::Scalar(70));
  cv::RNG random(4);
  const int side = size.height / 12;
  for (int n = 0; n < 400; ++n) {
    const cv::Point corner(random.uniform(0, size.width), random.uniform(0, size.height));
    const cv::Size box(random.uniform(side / 4, side), random.uniform(side / 4, side));
    cv::rectangle(room, {corner, box}, cv::Scalar(random.uniform(30, 200)), cv::FILLED);
  }
  cv::GaussianBlur(room, room, {}, 1);
  return room;
}

std::vector<cv::Mat> noisy_pictures(PixelFormat format, const cv::Size& size) {
  const cv::Mat room = room_of_boxes(size);
  cv::RNG random(5);
  std::vector<cv::Mat> pictures;
  for (std::size_t n = 0; n < kPictures; ++n) {
    cv::Mat noise(size, CV_32F), picture;
    random.fill(noise, cv::RNG::NORMAL, 0, 1.5);
    if (format == PixelFormat::Y16) {
      cv::Mat(room + noise).convertTo(picture, CV_16U, 20, 7000);
    } else {
      cv::Mat(room + noise).convertTo(picture, CV_8U);
      cv::cvtColor(picture, picture, cv::COLOR_GRAY2RGB);
    }
    pictures.push_back(picture);
  }
  return pictures;
}

std::filesystem::path new_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "watched_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) std::abort();
  return name;
}

}  // namespace

WatchedMachine::WatchedMachine() : folder_(new_folder()) {
  add_camera(PixelFormat::Rgb, {1000, 1000}, 478);
  add_camera(PixelFormat::Y16, {320, 256}, 116);
  for (std::size_t n = 0; n < kFirstSets; ++n) look();
}

WatchedMachine::~WatchedMachine() {
  std::error_code error;
  std::filesystem::remove_all(folder_, error);
}

void WatchedMachine::add_camera(PixelFormat format, const cv::Size& size, double radius) {
  const std::string name = "camera" + std::to_string(cameras_.size());
  const optics::Outline limb{{(size.width - 1) / 2.0, (size.height - 1) / 2.0}, radius, radius, 0};
  const auto model = optics::BallModel::make(optics::BallModel::Kind::Exact, std::nullopt, 12);
  const auto projection = optics::BallProjection::make(*model, limb, {});
  const align::DriftSubject subject{size.width, size.height, limb, *projection, std::nullopt};
  cameras_.push_back(
      {app::AlignmentWatch::make(name, subject, {}, folder_, 0).value(),
       app::BallWatch::make(name, size.width, size.height, limb, {}, folder_).value(), format,
       noisy_pictures(format, size)});
}

bool WatchedMachine::look() {
  const hal::TimePoint stamp{std::chrono::hours(1) +
                             sets_ * std::chrono::nanoseconds(1'000'000'000 / kSetsPerSecond)};
  bool is_good = true;
  for (Camera& camera : cameras_) {
    const cv::Mat& pixels = camera.pictures[sets_ % kPictures];
    const Picture picture = Picture::contiguous(camera.format, pixels.cols, pixels.rows,
                                                reinterpret_cast<const std::byte*>(pixels.data),
                                                static_cast<std::ptrdiff_t>(pixels.step));
    app::CameraWatchStatus figures;
    camera.alignment.observe(picture, stamp, figures);
    camera.ball.observe(picture, stamp, figures);
    is_good = is_good && figures.alignment == app::AlignmentLevel::Good &&
              figures.focus == app::WatchLevel::Good;
  }
  ++sets_;
  return is_good;
}

}  // namespace orbwatch::bench
