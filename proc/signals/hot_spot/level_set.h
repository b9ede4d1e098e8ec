#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "proc/image/image_view.h"
#include "proc/optics/vec.h"
#include "proc/signals/region.h"

namespace orbwatch::signals {

/// A run of pixels in a row that belongs to a blob.
struct Run {
  Span span;
  std::size_t blob = 0;
};

/// A connected component (8 neighbours) at or above a threshold.
struct Blob {
  double solid_angle = 0;  ///< steradian, of whole pixels
  optics::Vec3 moment;     ///< directions weighted by solid angle and counts above the threshold
  double area = 0;         ///< mm2 of the machine's surface; not a number if far
  optics::Vec3 position;   ///< mm from the ball's centre, weighted by solid angle; likewise
  int peak = 0;            ///< counts of its brightest pixel, and where that is
  int peak_x = 0;
  int peak_y = 0;
  std::size_t root = 0;  ///< itself, or the blob that it was joined to
};

/// The blobs of a region at one threshold. Allocates when it is made only. Thread-bound.
class LevelSet {
 public:
  /// At or above `threshold`, counts.
  LevelSet(const RegionMask& mask, double threshold);

  /// Finds the blobs of values that are Validity::Seen, within the region.
  template <class T>
  void find(const ImageView<const T>& values, const ImageView<const std::uint8_t>& validity,
            const RegionMask& mask, const RegionGeometry& geometry);

  /// The same within the runs of a lower threshold of the same picture, which hold them all.
  template <class T>
  void find(const ImageView<const T>& values, const LevelSet& lower,
            const RegionGeometry& geometry);

  double threshold() const { return threshold_; }

  /// By row, then from left to right, each with the index of its whole blob.
  std::span<const Run> runs() const { return runs_; }

  bool is_whole(std::size_t blob) const { return blobs_[blob].root == blob; }
  std::size_t size() const { return blobs_.size(); }  ///< with those that are parts of others
  const Blob& blob(std::size_t index) const { return blobs_[index]; }

  /// The whole blob that pixel belongs to; kNone when it belongs to none.
  std::size_t blob_at(int x, int y) const;

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

 private:
  template <class T>
  void add_run(const T* values, const Span& span, const RegionGeometry& geometry);
  void start();
  void join_rows(int y);
  void join(std::size_t a, std::size_t b);
  std::size_t root(std::size_t blob);
  void finish();

  double threshold_;
  int level_;  ///< the least whole count at or above it
  std::vector<Run> runs_;
  std::vector<Blob> blobs_;
  std::size_t row_begin_ = 0;    ///< first run of the row being filled
  std::size_t above_begin_ = 0;  ///< first run of the row before; its end is row_begin_
};

}  // namespace orbwatch::signals
