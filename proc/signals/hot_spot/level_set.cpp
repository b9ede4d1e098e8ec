#include "proc/signals/hot_spot/level_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace orbwatch::signals {
namespace {

constexpr auto kSeen = static_cast<std::uint8_t>(Validity::Seen);

/// The first of values[x, end) that is at least `level`, or `end`. Blocks that are all cold, as
/// nearly all of a picture is, cost one comparison per vector.
template <class T>
int first_hot(const T* values, int x, int end, int level) {
  constexpr int kBlock = 32;
  for (; x + kBlock <= end; x += kBlock) {
    T hottest = 0;
    for (int i = 0; i < kBlock; ++i) hottest = std::max(hottest, values[x + i]);
    if (hottest >= level) break;
  }
  while (x < end && values[x] < level) ++x;
  return x;
}

optics::Vec3 vec(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

LevelSet::LevelSet(const RegionMask& mask, double threshold)
    : threshold_(threshold),
      level_(static_cast<int>(std::ceil(std::clamp(threshold, 0.0, 65536.0)))) {
  runs_.reserve(mask.most_runs());
  blobs_.reserve(mask.most_runs());
}

template <class T>
void LevelSet::find(const ImageView<const T>& values, const ImageView<const std::uint8_t>& validity,
                    const RegionMask& mask, const RegionGeometry& geometry) {
  start();
  for (const Span& span : mask.spans()) {
    const T* value = values.row(span.y);
    const std::uint8_t* seen = validity.row(span.y);
    for (int x = first_hot(value, span.begin, span.end, level_); x < span.end;) {
      const int begin = x;
      while (x < span.end && value[x] >= level_ && seen[x] == kSeen) ++x;
      if (x > begin) add_run(value, {span.y, begin, x}, geometry);
      x = first_hot(value, x + 1, span.end, level_);
    }
  }
  finish();
}

template <class T>
void LevelSet::find(const ImageView<const T>& values, const LevelSet& lower,
                    const RegionGeometry& geometry) {
  start();
  for (const Run& run : lower.runs()) {
    const Span& span = run.span;
    const T* value = values.row(span.y);
    for (int x = span.begin; x < span.end; ++x) {
      const int begin = x;
      while (x < span.end && value[x] >= level_) ++x;
      if (x > begin) add_run(value, {span.y, begin, x}, geometry);
    }
  }
  finish();
}

template <class T>
void LevelSet::add_run(const T* values, const Span& span, const RegionGeometry& geometry) {
  if (runs_.empty() || runs_.back().span.y != span.y) {
    if (!runs_.empty()) join_rows(runs_.back().span.y);
    const bool next_row = !runs_.empty() && runs_.back().span.y + 1 == span.y;
    above_begin_ = next_row ? row_begin_ : runs_.size();
    row_begin_ = runs_.size();
  }
  Blob blob;
  blob.root = blobs_.size();
  for (int x = span.begin; x < span.end; ++x) {
    const PixelGeometry& pixel = geometry.at(x, span.y);
    // Counting from just below the threshold keeps a blob of equal values a plain centroid.
    const double weight = pixel.solid_angle * (values[x] - threshold_ + 1);
    blob.solid_angle += pixel.solid_angle;
    blob.moment = blob.moment + vec(pixel.direction) * weight;
    blob.area += pixel.area;
    blob.position = blob.position + vec(pixel.position) * pixel.solid_angle;
    if (values[x] > blob.peak || x == span.begin) {
      blob.peak = values[x];
      blob.peak_x = x;
      blob.peak_y = span.y;
    }
  }
  runs_.push_back({span, blob.root});
  blobs_.push_back(blob);
}

void LevelSet::start() {
  runs_.clear();
  blobs_.clear();
  row_begin_ = above_begin_ = 0;
}

/// Joins the runs of the row that is complete with those above. Diagonal neighbours count: runs
/// touch when they overlap by one pixel more on either side.
void LevelSet::join_rows(int y) {
  std::size_t above = above_begin_;
  for (std::size_t i = row_begin_; i < runs_.size() && runs_[i].span.y == y; ++i) {
    const Span& span = runs_[i].span;
    while (above < row_begin_ && runs_[above].span.end < span.begin) ++above;
    for (std::size_t j = above; j < row_begin_ && runs_[j].span.begin <= span.end; ++j) {
      join(runs_[j].blob, runs_[i].blob);
    }
  }
}

void LevelSet::join(std::size_t a, std::size_t b) {
  const std::size_t kept_index = std::min(root(a), root(b));
  const std::size_t joined_index = std::max(root(a), root(b));
  if (kept_index == joined_index) return;
  Blob& kept = blobs_[kept_index];
  Blob& joined = blobs_[joined_index];
  kept.solid_angle += joined.solid_angle;
  kept.moment = kept.moment + joined.moment;
  kept.area += joined.area;
  kept.position = kept.position + joined.position;
  if (joined.peak > kept.peak) {
    kept.peak = joined.peak;
    kept.peak_x = joined.peak_x;
    kept.peak_y = joined.peak_y;
  }
  joined.root = kept_index;
}

std::size_t LevelSet::root(std::size_t blob) {
  while (blobs_[blob].root != blob) {
    blobs_[blob].root = blobs_[blobs_[blob].root].root;
    blob = blobs_[blob].root;
  }
  return blob;
}

void LevelSet::finish() {
  if (!runs_.empty()) join_rows(runs_.back().span.y);
  for (Run& run : runs_) run.blob = root(run.blob);
}

std::size_t LevelSet::blob_at(int x, int y) const {
  const auto after = std::ranges::upper_bound(runs_, std::pair(y, x), {}, [](const Run& run) {
    return std::pair(run.span.y, run.span.begin);
  });
  if (after == runs_.begin()) return kNone;
  const Run& run = *std::prev(after);
  return run.span.y == y && x < run.span.end ? run.blob : kNone;
}

template void LevelSet::find(const ImageView<const std::uint8_t>&,
                             const ImageView<const std::uint8_t>&, const RegionMask&,
                             const RegionGeometry&);
template void LevelSet::find(const ImageView<const std::uint16_t>&,
                             const ImageView<const std::uint8_t>&, const RegionMask&,
                             const RegionGeometry&);
template void LevelSet::find(const ImageView<const std::uint8_t>&, const LevelSet&,
                             const RegionGeometry&);
template void LevelSet::find(const ImageView<const std::uint16_t>&, const LevelSet&,
                             const RegionGeometry&);

}  // namespace orbwatch::signals
