// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/merge/photometric_match.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "proc/remap/merge/line_fit.h"

namespace orbwatch::remap {
namespace {

using Outcome = PhotometricMatch::Outcome;

constexpr int kBlock = 8;
/// Blocks along a side; if there are more, some are skipped without loss.
constexpr int kMostBlocks = 256;
/// Samples below or above these shares of full scale may be clipped. Counts have no toe.
constexpr double kNearlyBlack = 4.0 / 255;
constexpr double kNearlySaturated = 250.0 / 255;
constexpr double kLargestGain = 16;
constexpr double kLargestOffset = 0.25;
/// Gauss-Seidel on at most kMaxSources unknowns.
constexpr int kRounds = 200;

template <class T>
constexpr double kFullScale = std::numeric_limits<T>::max();

/// One source's content in the blocks of the view.
struct Blocks {
  std::vector<double> weight;  ///< 0 where it does not see all of a block
  /// Mean light per channel; NaN where samples may be clipped.
  std::array<std::vector<double>, 3> light;
};

/// Mean light per channel of the block at (x0, y0).
template <class T>
class BlockReader {
 public:
  explicit BlockReader(Transfer transfer) : light_(std::size_t{std::numeric_limits<T>::max()} + 1) {
    const double lowest = transfer == Transfer::Srgb ? kNearlyBlack : 1 / kFullScale<T>;
    for (std::size_t code = 0; code < light_.size(); ++code) {
      const double sample = static_cast<double>(code) / kFullScale<T>;
      const bool usable = sample >= lowest && sample <= kNearlySaturated;
      light_[code] = usable ? to_light(transfer, sample) : std::nan("");
    }
  }

  void read(const MergeSource<T>& source, int x0, int y0, Blocks& blocks) const {
    const int channels = source.picture.channels;
    std::array<double, 3> sum{};
    int weight = 0;
    bool whole = true;
    for (int y = y0; y < y0 + kBlock; ++y) {
      for (int x = x0; x < x0 + kBlock; ++x) {
        const int here = *source.weights.at(x, y);
        whole &= here > 0;
        weight += here;
        const T* samples = source.picture.at(x, y);
        for (int k = 0; k < channels; ++k) sum[k] += light_[samples[k]];
      }
    }
    blocks.weight.push_back(whole ? weight : 0);
    for (int k = 0; k < channels; ++k) blocks.light[k].push_back(sum[k] / (kBlock * kBlock));
  }

 private:
  std::vector<double> light_;
};

template <class T>
Blocks blocks_of(const BlockReader<T>& reader, const MergeSource<T>& source) {
  const auto step = [](int side) {
    const int blocks = side / kBlock;
    return kBlock * ((blocks + kMostBlocks - 1) / kMostBlocks);
  };
  Blocks blocks;
  const int width = source.picture.width, height = source.picture.height;
  for (int y = 0; y + kBlock <= height; y += step(height)) {
    for (int x = 0; x + kBlock <= width; x += step(width)) reader.read(source, x, y, blocks);
  }
  return blocks;
}

/// Relation of two sources: light of `a` = slope * light of `b` + offset, per channel.
struct Pair {
  std::size_t a;
  std::size_t b;
  std::array<Line, 3> lines;
};

std::optional<Pair> compare(std::span<const Blocks> sources, std::size_t a, std::size_t b,
                            int channels) {
  Pair pair{a, b, {}};
  for (int k = 0; k < channels; ++k) {
    std::vector<Measured> measured;
    for (std::size_t i = 0; i < sources[a].weight.size(); ++i) {
      const double weight = std::min(sources[a].weight[i], sources[b].weight[i]);
      const double x = sources[b].light[k][i], y = sources[a].light[k][i];
      if (weight > 0 && std::isfinite(x) && std::isfinite(y)) measured.push_back({x, y, weight});
    }
    const auto line = fit_line(measured);
    if (!line) return std::nullopt;
    pair.lines[k] = *line;
  }
  return pair;
}

/// For every source, the first one that it is compared with, directly or through others.
std::vector<std::size_t> references(std::size_t count, std::span<const Pair> pairs) {
  std::vector<std::size_t> reference(count);
  for (std::size_t n = 0; n < count; ++n) reference[n] = n;
  for (std::size_t round = 0; round < count; ++round) {
    for (const Pair& p : pairs) {
      reference[p.a] = reference[p.b] = std::min(reference[p.a], reference[p.b]);
    }
  }
  return reference;
}

/// Solves for one number per source from the differences between pairs (number of b - number of a),
/// by weighted least squares; references keep theirs.
template <class Difference>
std::array<double, kMaxSources> solve(std::span<const Pair> pairs, int channel,
                                      std::span<const std::size_t> reference,
                                      const Difference& difference) {
  std::array<double, kMaxSources> value{};
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t n = 0; n < reference.size(); ++n) {
      if (reference[n] == n) continue;
      double sum = 0, weight = 0;
      for (const Pair& p : pairs) {
        if (p.a != n && p.b != n) continue;
        const double w = p.lines[channel].weight, d = difference(p);
        sum += w * (p.b == n ? value[p.a] + d : value[p.b] - d);
        weight += w;
      }
      value[n] = sum / weight;
    }
  }
  return value;
}

bool is_plausible(const PhotometricMatch::Channel& channel) {
  return channel.gain >= 1 / kLargestGain && channel.gain <= kLargestGain &&
         std::abs(channel.offset) <= kLargestOffset;
}

std::vector<PhotometricMatch> join(std::size_t count, std::span<const Pair> pairs, int channels) {
  const std::vector<std::size_t> reference = references(count, pairs);
  std::vector<PhotometricMatch> matches(count);
  for (int k = 0; k < channels; ++k) {
    const auto log_gains =
        solve(pairs, k, reference, [k](const Pair& p) { return std::log(p.lines[k].slope); });
    std::array<double, kMaxSources> gain{};
    for (std::size_t n = 0; n < count; ++n) gain[n] = std::exp(log_gains[n]);
    const auto offsets = solve(pairs, k, reference, [&](const Pair& p) {
      return gain[p.a] * p.lines[k].mean_y - gain[p.b] * p.lines[k].mean_x;
    });
    for (std::size_t n = 0; n < count; ++n) matches[n].channels[k] = {gain[n], offsets[n]};
  }
  for (std::size_t n = 1; n < count; ++n) {
    const auto& c = matches[n].channels;
    matches[n].outcome = reference[n] == n                               ? Outcome::TooLittle
                         : std::all_of(c.begin(), c.end(), is_plausible) ? Outcome::Matched
                                                                         : Outcome::Implausible;
    if (matches[n].outcome != Outcome::Matched) matches[n].channels = {};
  }
  return matches;
}

}  // namespace

template <class T>
std::vector<PhotometricMatch> match_photometry(std::span<const MergeSource<T>> sources,
                                               Transfer transfer) {
  assert(sources.size() <= kMaxSources);
  const BlockReader<T> reader(transfer);
  std::vector<Blocks> blocks;
  for (const auto& source : sources) blocks.push_back(blocks_of(reader, source));
  const int channels = sources.empty() ? 0 : sources.front().picture.channels;
  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < sources.size(); ++a) {
    for (std::size_t b = a + 1; b < sources.size(); ++b) {
      if (const auto pair = compare(blocks, a, b, channels)) pairs.push_back(*pair);
    }
  }
  return join(sources.size(), pairs, channels);
}

PhotometricTable::PhotometricTable(const PhotometricMatch& match, PixelFormat format) {
  const Transfer transfer = transfer_of(format);
  const int full_scale = (1 << 8 * info(format).bytes_per_sample()) - 1;
  const auto table_of = [&](const PhotometricMatch::Channel& channel) {
    Samples table;
    for (int code = 0; code <= full_scale; ++code) {
      const double light = to_light(transfer, static_cast<double>(code) / full_scale);
      const double matched = channel.gain * light + channel.offset;
      const double sample = from_light(transfer, std::clamp(matched, 0.0, 1.0));
      table.push_back(static_cast<std::uint16_t>(std::lround(sample * full_scale)));
    }
    return table;
  };
  for (int k = 0; k < info(format).channels(); ++k) samples_[k] = table_of(match.channels[k]);
  if (format != PixelFormat::Rgb) return;
  const auto weighed = [&match](double PhotometricMatch::Channel::*member) {
    const auto& [red, green, blue] = match.channels;
    return 0.299 * red.*member + 0.587 * green.*member + 0.114 * blue.*member;
  };
  luma_ = table_of(
      {weighed(&PhotometricMatch::Channel::gain), weighed(&PhotometricMatch::Channel::offset)});
}

template <class T>
void PhotometricTable::apply(const ImageView<T>& picture, PixelFormat format) const {
  std::array<const Samples*, 3> tables{&samples_[0], &samples_[1], &samples_[2]};
  if (format == PixelFormat::Bgr) std::swap(tables[0], tables[2]);
  if (picture.channels == 1 && !luma_.empty()) tables[0] = &luma_;
  for (int y = 0; y < picture.height; ++y) {
    T* sample = picture.row(y);
    for (int x = 0; x < picture.width; ++x) {
      for (int k = 0; k < picture.channels; ++k, ++sample) {
        *sample = static_cast<T>((*tables[k])[*sample]);
      }
    }
  }
}

template std::vector<PhotometricMatch> match_photometry(std::span<const MergeSource<std::uint8_t>>,
                                                        Transfer);
template std::vector<PhotometricMatch> match_photometry(std::span<const MergeSource<std::uint16_t>>,
                                                        Transfer);
template void PhotometricTable::apply(const ImageView<std::uint8_t>&, PixelFormat) const;
template void PhotometricTable::apply(const ImageView<std::uint16_t>&, PixelFormat) const;

}  // namespace orbwatch::remap
