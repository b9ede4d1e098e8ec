#include "proc/remap/merge.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "proc/image/validity.h"

namespace orbwatch::remap {
namespace {

constexpr int kShareBits = 8;

}  // namespace

MergeWeights::MergeWeights(std::span<const double> weights) {
  assert(weights.size() <= kMaxSources);
  for (std::size_t mask = 0; mask < shares_.size(); ++mask) {
    double total = 0;
    for (std::size_t n = 0; n < weights.size(); ++n) total += (mask >> n & 1) ? weights[n] : 0;
    if (!(total > 0)) continue;
    // Rounding the running sum makes the shares add up exactly.
    double sum = 0;
    long given = 0;
    for (std::size_t n = 0; n < weights.size(); ++n) {
      sum += (mask >> n & 1) ? weights[n] : 0;
      const long upto = std::lround(sum / total * (1 << kShareBits));
      shares_[mask][n] = static_cast<std::uint16_t>(upto - std::exchange(given, upto));
    }
  }
}

void merge(std::span<const ImageView<const std::uint8_t>> sources,
           const ImageView<const std::uint8_t>& coverage, const MergeWeights& weights,
           const ImageView<std::uint8_t>& rgb, const ImageView<std::uint8_t>& validity,
           TileRows rows) {
  const int last = std::min(rows.last * kTile, rgb.height);
  for (int y = rows.first * kTile; y < last; ++y) {
    std::array<const std::uint8_t*, kMaxSources> in{};
    for (std::size_t n = 0; n < sources.size(); ++n) in[n] = sources[n].row(y);
    std::uint8_t* out = rgb.row(y);
    for (int x = 0; x < rgb.width; ++x, out += 3) {
      const auto& shares = weights.shares(coverage.row(y)[x]);
      std::array<int, 3> sum{1 << (kShareBits - 1), 1 << (kShareBits - 1), 1 << (kShareBits - 1)};
      int given = 0;
      for (std::size_t n = 0; n < sources.size(); ++n) {
        for (int k = 0; k < 3; ++k) sum[k] += shares[n] * in[n][3 * x + k];
        given += shares[n];
      }
      for (int k = 0; k < 3; ++k) out[k] = static_cast<std::uint8_t>(sum[k] >> kShareBits);
      if (given > 0) *validity.at(x, y) = static_cast<std::uint8_t>(Validity::Seen);
    }
  }
}

}  // namespace orbwatch::remap
