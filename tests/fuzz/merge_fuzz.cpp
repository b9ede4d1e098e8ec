// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "proc/remap/remap.h"
#include "tests/fuzz/fenced_picture.h"
#include "tests/fuzz/remap_scene.h"
#include "tests/fuzz/stop.h"

/// Random cameras in one view, merged into every format: all kernels write the same bytes, all
/// formats show the same, measured planes and validity do not depend on the format shown, and
/// nothing is read or written outside of the pictures.
namespace orbwatch::fuzz {
namespace {

using remap::Interpolation;
using remap::Kernel;

/// A camera, its map in the view, and its picture.
struct Camera {
  Camera(RemapScene&& of, PixelFormat format, int padding)
      : scene(std::move(of)),
        source(format, scene.grid.source_width(), scene.grid.source_height(), padding),
        pyramid(format, scene.grid.source_width(), scene.grid.source_height(), 1) {}

  RemapScene scene;
  FencedPicture source;
  remap::Pyramid pyramid;
  bool delivers = true;
};

constexpr std::array kSources{
    PixelFormat::Grey, PixelFormat::Y16,  PixelFormat::Yuyv, PixelFormat::Uyvy, PixelFormat::Nv12,
    PixelFormat::Nv21, PixelFormat::I420, PixelFormat::Rgb,  PixelFormat::Bgr,  PixelFormat::Bgra};

remap::ColourMap colour_map() {
  remap::ColourMap::Table table{};
  std::minstd_rand random(2);
  for (auto& entry : table) {
    for (auto& sample : entry) sample = static_cast<std::uint8_t>(random());
  }
  return {table, 20, 60000};
}

class Merge {
 public:
  explicit Merge(FuzzedDataProvider& bytes) {
    const int count = bytes.ConsumeIntegralInRange(1, 4);
    for (int n = 0; n < count; ++n) add(bytes);
    if (cameras_.empty()) return;
    rule_ = bytes.ConsumeBool() ? remap::MergeRule::Mean : remap::MergeRule::First;
    interpolation_ = static_cast<Interpolation>(bytes.ConsumeIntegralInRange(0, 2));
    padding_ = bytes.ConsumeIntegralInRange(0, 40);
    measured_ = bytes.ConsumeIntegralInRange<std::size_t>(0, cameras_.size());
    std::vector<remap::BlendSource> sources;
    for (const auto& camera : cameras_) {
      const remap::CoordinateGrid& grid = camera->scene.grid;
      sources.push_back({camera->scene.ball, grid.source_width(), grid.source_height(),
                         1.0 + bytes.ConsumeIntegralInRange(0, 9), std::nullopt});
    }
    blend_.emplace(cameras_.front()->scene.view, sources);
  }

  void check() const {
    if (cameras_.empty()) return;
    const Shown rgb = check_kernels(PixelFormat::Rgb);
    const Shown bgr = check_kernels(PixelFormat::Bgr);
    const Shown grey = check_kernels(PixelFormat::Grey);
    const Shown none = check_kernels(std::nullopt);
    for (std::size_t i = 0; i + 2 < rgb.picture.size(); i += 3) {
      require(rgb.picture[i] == bgr.picture[i + 2] && rgb.picture[i + 1] == bgr.picture[i + 1] &&
                  rgb.picture[i + 2] == bgr.picture[i],
              "bgr is not rgb");
    }
    std::vector<const Shown*> all{&bgr, &grey, &none};
    std::optional<Shown> yuv;
    if (width() % 2 == 0 && height() % 2 == 0) {
      all.push_back(&yuv.emplace(check_kernels(PixelFormat::I420)));
    }
    for (const Shown* other : all) {
      require(other->measured == rgb.measured, "what is measured depends on what is shown");
      require(other->validity == rgb.validity, "what is seen depends on what is shown");
    }
    for (std::size_t i = 0; i < rgb.validity.size(); ++i) {
      if (rgb.validity[i] == static_cast<std::byte>(Validity::Seen)) continue;
      require(grey.picture[i] == std::byte{0} && rgb.picture[3 * i] == std::byte{0},
              "what is not seen is not black");
    }
  }

 private:
  struct Shown {
    std::vector<std::byte> picture, measured, validity;
    bool operator==(const Shown&) const = default;
  };

  int width() const { return cameras_.front()->scene.grid.width(); }
  int height() const { return cameras_.front()->scene.grid.height(); }

  /// Adds a camera to the first camera's view.
  void add(FuzzedDataProvider& bytes) {
    const PixelFormat format =
        kSources[bytes.ConsumeIntegralInRange<std::size_t>(0, kSources.size() - 1)];
    auto scene = make_scene(bytes, info(format).colour == ColourModel::Yuv);
    if (!scene) return;
    if (!cameras_.empty()) {
      const SourceSize size{scene->grid.source_width(), scene->grid.source_height()};
      scene.emplace(cameras_.front()->scene.view, optics::BallProjection(scene->ball), size);
    }
    auto camera =
        std::make_unique<Camera>(std::move(*scene), format, bytes.ConsumeIntegralInRange(0, 40));
    std::minstd_rand random(bytes.ConsumeIntegral<std::uint16_t>() + 1U);
    const bool extreme = bytes.ConsumeBool();
    camera->source.for_each_row([&](std::span<std::byte> pixels, std::span<std::byte>) {
      for (std::byte& sample : pixels) {
        sample = static_cast<std::byte>(extreme ? (random() >> 8 & 1) * 0xff : random() >> 8);
      }
    });
    camera->source.picture.colour_space = {static_cast<ColourMatrix>(bytes.ConsumeBool()),
                                           static_cast<ColourRange>(bytes.ConsumeBool())};
    camera->source.forbid_padding();
    camera->pyramid.set_source(camera->source.picture);
    camera->pyramid.fill();
    camera->delivers = bytes.ConsumeIntegralInRange(0, 7) > 0;
    cameras_.push_back(std::move(camera));
  }

  static std::vector<std::byte> pixels_of(const FencedPicture& picture, std::byte before) {
    std::vector<std::byte> all;
    picture.for_each_row([&](std::span<std::byte> pixels, std::span<std::byte> padding) {
      all.insert(all.end(), pixels.begin(), pixels.end());
      require(std::ranges::all_of(padding, [before](std::byte b) { return b == before; }),
              "writes between rows");
    });
    return all;
  }

  Shown merge(std::optional<PixelFormat> format, const Kernel& kernel, std::byte before) const {
    FencedPicture out(format.value_or(PixelFormat::Grey), width(), height(), padding_);
    FencedPicture validity(PixelFormat::Grey, width(), height(), padding_);
    const bool is_measured = measured_ < cameras_.size();
    const PixelFormat own =
        is_measured ? cameras_[measured_]->source.picture.format : PixelFormat::Grey;
    const bool counts = own == PixelFormat::Y16;
    FencedPicture measured(counts ? own : PixelFormat::Grey, width(), height(),
                           counts ? padding_ / 2 * 2 : padding_);
    for (FencedPicture* picture : {&out, &validity, &measured}) picture->fill(before);
    if (format == PixelFormat::I420) out.picture.colour_space = remap::kJfif;

    std::vector<remap::MergedSource> sources;
    for (std::size_t n = 0; n < cameras_.size(); ++n) {
      remap::MergedSource source{&cameras_[n]->scene.grid, {}, &colours_, {}, nullptr, {}};
      if (cameras_[n]->delivers) source.pictures = cameras_[n]->pyramid.pictures();
      if (n == measured_) source.measured = measured.picture;
      sources.push_back(source);
    }
    const std::vector<std::uint8_t> unseen(static_cast<std::size_t>(width()) * height(),
                                           static_cast<std::uint8_t>(Validity::Blind));
    const remap::MergePlan plan{
        &*blend_, rule_, interpolation_, {unseen.data(), width(), height(), 1, width()}};
    remap::merged_remap(sources, plan, format ? out.picture : MutablePicture{},
                        validity.picture.samples<std::uint8_t>(),
                        {0, cameras_.front()->scene.grid.tiles_y()}, kernel);
    Shown shown{{}, {}, pixels_of(validity, before)};
    if (format) shown.picture = pixels_of(out, before);
    if (is_measured) shown.measured = pixels_of(measured, before);
    return shown;
  }

  /// Two initial values, so that a byte that no kernel writes is also detected.
  Shown check_kernels(std::optional<PixelFormat> format) const {
    Shown expected = merge(format, *remap::kernels().front(), std::byte{0x5a});
    for (const Kernel* kernel : remap::kernels()) {
      if (merge(format, *kernel, std::byte{0xa5}) == expected) continue;
      stop(std::string(kernel->name) + " differs from scalar in " +
           (format ? std::string(info(*format).name) : "nothing"));
    }
    return expected;
  }

  const remap::ColourMap colours_ = colour_map();
  std::vector<std::unique_ptr<Camera>> cameras_;
  std::optional<remap::BlendGrid> blend_;
  remap::MergeRule rule_ = remap::MergeRule::Mean;
  Interpolation interpolation_ = Interpolation::Bilinear;
  std::size_t measured_ = 0;
  int padding_ = 0;
};

}  // namespace
}  // namespace orbwatch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider bytes(data, size);
  orbwatch::fuzz::Merge(bytes).check();
  return 0;
}
