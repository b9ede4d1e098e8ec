// SPDX-License-Identifier: Apache-2.0
#include "hal/test_pattern/test_pattern_camera.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "hal/test_pattern/painted_number.h"

namespace orbwatch::hal {
namespace {

constexpr double kNoise = 0.002;           ///< share of a sample's full scale
constexpr int kMaxTestPatternSide = 8192;  ///< pixels; ten buffers of this size are drawn
constexpr int kDiscShare = 40;             ///< picture height divided by the disc's radius

template <class Sample>
void draw(const BasicPicture<std::byte>::Plane& plane, int samples, int rows, int bits,
          std::minstd_rand& random) {
  const double full = (1 << bits) - 1;
  const int per_column = std::max(1, samples / std::max(1, rows));
  const int radius = rows / kDiscShare + 1;
  for (int y = 0; y < rows; ++y) {
    auto* const row = reinterpret_cast<Sample*>(plane.data + y * plane.stride);
    for (int x = 0; x < samples; ++x) {
      const int dx = (x - samples / 2) / per_column, dy = y - rows / 2;
      const bool is_disc = dx * dx + dy * dy <= radius * radius;
      const double noise = kNoise * static_cast<double>(random() % 1000) / 1000;
      row[x] = static_cast<Sample>(full * ((is_disc ? kBrightLevel : kDarkLevel) + noise));
    }
  }
}

/// Fills a buffer of its own format; each `seed` gives different noise.
void draw(FrameBuffer& buffer, unsigned seed) {
  const Picture& picture = buffer.picture;
  const PixelFormatInfo& format = info(picture.format);
  const auto out = MutablePicture::contiguous(picture.format, picture.width, picture.height,
                                              buffer.memory, picture.planes[0].stride);
  std::minstd_rand random(seed);
  for (std::size_t n = 0; n < format.plane_count(); ++n) {
    const PlaneInfo& plane = format.planes[n];
    const int samples = (picture.width >> plane.shift_x) * plane.samples;
    const int rows = picture.height >> plane.shift_y;
    if (format.bytes_per_sample() == 2) {
      draw<std::uint16_t>(out.planes[n], samples, rows, format.bits, random);
    } else {
      draw<std::uint8_t>(out.planes[n], samples, rows, format.bits, random);
    }
  }
}

FramePool drawn_pool(const StreamFormat& format, std::size_t buffers) {
  FramePool pool = make_frame_pool(format.format, format.width, format.height, buffers);
  std::vector<std::shared_ptr<FrameBuffer>> all;
  for (unsigned seed = 1; const auto buffer = pool.acquire(); ++seed) {
    draw(*buffer, seed);
    all.push_back(buffer);
  }
  return pool;
}

/// True if the subsampled planes have whole samples.
bool is_whole(PixelFormat format, int width, int height) {
  int columns = format == PixelFormat::Yuyv || format == PixelFormat::Uyvy ? 2 : 1, rows = 1;
  for (const PlaneInfo& plane : info(format).planes) {
    columns = std::max(columns, 1 << plane.shift_x);
    rows = std::max(rows, 1 << plane.shift_y);
  }
  return width % columns == 0 && height % rows == 0;
}

}  // namespace

TestPatternCamera::TestPatternCamera(TestPatternSettings settings)
    : Camera({settings.name, "test pattern", std::string(TestPatternSettings::kName)}),
      settings_(std::move(settings)),
      script_(settings_.faults) {}

TestPatternCamera::~TestPatternCamera() { stop(); }

Result<StreamFormat> TestPatternCamera::do_configure(const StreamRequest& request) {
  StreamFormat format{
      settings_.pixel_format, {}, settings_.width, settings_.height, settings_.frame_rate};
  if (request.width != 0) format.width = request.width;
  if (request.height != 0) format.height = request.height;
  if (request.frame_rate != 0) format.frame_rate = request.frame_rate;
  if (format.frame_rate == 0) format.frame_rate = kTestPatternRate;
  if (std::min(format.width, format.height) < 1 ||
      std::max(format.width, format.height) > kMaxTestPatternSide ||
      !is_whole(format.format, format.width, format.height)) {
    return fail("camera " + info().id + ": size " + std::to_string(format.width) + "x" +
                std::to_string(format.height) + " of " +
                std::string(orbwatch::info(format.format).name) +
                "; state width and height, at most " + std::to_string(kMaxTestPatternSide) +
                ", and even where pixels share colour");
  }
  pool_ = drawn_pool(format, request.buffers);
  format_ = format;
  return format_;
}

void TestPatternCamera::run(const std::stop_token&) {
  const TimePoint start = Clock::now();
  const std::chrono::duration<double> period(1 / format_.frame_rate);
  const auto moment = [&](std::uint64_t n) {
    return start + std::chrono::round<Clock::duration>(static_cast<double>(n) * period);
  };
  for (std::uint64_t n = 0; wait_until(moment(n)); ++n) {
    const FrameMetadata metadata{.sequence = n, .exposure_start = moment(n)};
    if (fails(script_, metadata)) continue;
    const auto buffer = pool_->acquire();
    if (!buffer) continue;  // lost: all buffers are in use
    buffer->metadata = metadata;
    if (settings_.numbered) paint_number(*buffer, n);
    deliver(buffer);
  }
}

std::unique_ptr<Camera> make_camera(TestPatternSettings settings, const CameraContext& context) {
  settings.name = context.name;
  if (context.frame_rate > 0) settings.frame_rate = context.frame_rate;
  settings.faults = context.faults;
  return std::make_unique<TestPatternCamera>(std::move(settings));
}

}  // namespace orbwatch::hal
