// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "proc/image/image_view.h"
#include "proc/signals/hot_spot/level_set.h"

namespace orbwatch::signals {

/// All blobs of a region at one threshold, pixel by pixel: the specification of Components,
/// LevelSet and BlobSearch. The order of every sum is part of it.
class ScalarLevelSet {
 public:
  template <class T>
  ScalarLevelSet(const ImageView<const T>& values, const ImageView<const std::uint8_t>& validity,
                 double threshold, const RegionMask& mask, const RegionGeometry& geometry) {
    for (const Span& span : mask.spans()) {
      for (int x = span.begin; x < span.end; ++x) {
        const auto belongs = [&](int at) {
          return at < span.end && *values.at(at, span.y) >= threshold &&
                 *validity.at(at, span.y) == static_cast<std::uint8_t>(Validity::Seen);
        };
        const int begin = x;
        while (belongs(x)) ++x;
        if (x > begin) add_run(values, threshold, {span.y, begin, x}, geometry);
      }
    }
  }

  std::size_t size() const { return runs_.size(); }
  bool is_whole(std::size_t blob) const { return roots_[blob] == blob; }
  const Blob& blob(std::size_t index) const { return blobs_[index]; }

  /// Spans of a blob, by row, then from left to right.
  std::vector<Span> spans_of(std::size_t blob) const {
    std::vector<Span> spans;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (root(i) == blob) spans.push_back(runs_[i]);
    }
    return spans;
  }

  std::optional<std::size_t> blob_at(int x, int y) const {
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (runs_[i].y == y && runs_[i].begin <= x && x < runs_[i].end) return root(i);
    }
    return std::nullopt;
  }

 private:
  template <class T>
  void add_run(const ImageView<const T>& values, double threshold, const Span& span,
               const RegionGeometry& geometry) {
    const auto vec = [](const std::array<float, 3>& v) { return optics::Vec3{v[0], v[1], v[2]}; };
    Blob blob;
    blob.first = span;
    for (int x = span.begin; x < span.end; ++x) {
      const PixelGeometry& pixel = geometry.at(x, span.y);
      const int value = *values.at(x, span.y);
      const double weight = pixel.solid_angle * (value - threshold + 1);
      blob.solid_angle += pixel.solid_angle;
      blob.moment = blob.moment + vec(pixel.direction) * weight;
      blob.area += pixel.area;
      blob.position = blob.position + vec(pixel.position) * pixel.solid_angle;
      if (value > blob.peak || x == span.begin) {
        blob.peak = value;
        blob.peak_x = x;
        blob.peak_y = span.y;
      }
    }
    const std::size_t added = runs_.size();
    runs_.push_back(span);
    roots_.push_back(added);
    blobs_.push_back(blob);
    for (std::size_t i = 0; i < added; ++i) {
      const Span& other = runs_[i];
      if (other.y == span.y - 1 && other.end >= span.begin && other.begin <= span.end) {
        join(root(i), root(added));
      }
    }
  }

  void join(std::size_t a, std::size_t b) {
    if (a == b) return;
    const std::size_t kept_index = std::min(a, b), joined_index = std::max(a, b);
    Blob& kept = blobs_[kept_index];
    const Blob& joined = blobs_[joined_index];
    kept.solid_angle += joined.solid_angle;
    kept.moment = kept.moment + joined.moment;
    kept.area += joined.area;
    kept.position = kept.position + joined.position;
    if (joined.peak > kept.peak) {
      kept.peak = joined.peak;
      kept.peak_x = joined.peak_x;
      kept.peak_y = joined.peak_y;
    }
    roots_[joined_index] = kept_index;
  }

  std::size_t root(std::size_t run) const {
    while (roots_[run] != run) run = roots_[run];
    return run;
  }

  std::vector<Span> runs_;
  std::vector<std::size_t> roots_;  ///< indexed by run
  std::vector<Blob> blobs_;         ///< indexed by run
};

}  // namespace orbwatch::signals
